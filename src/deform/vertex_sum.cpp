#include "deform/vertex_sum.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "deform/map_rows.h"
#include "deform/scheme.h"
#include "deform/vertex_sample.h"

namespace viete::deform {

namespace {

VertexSum::Term term_of(const Rows& rows, bool has_logs, std::size_t handle, double weight) {
  VertexSum::Term term{static_cast<std::uint32_t>(handle), weight};
  if (!has_logs) return term;
  const double* x = rows.values.data() + handle * rows.columns();
  term.stretch = {x[0], x[1], x[2], x[3], x[4], x[5]};
  term.turn = {x[6], x[7], x[8]};
  const double* center = x + shape(rows.form).center;
  term.at = rows.origin + Vec3{center[0], center[1], center[2]};
  return term;
}

void add(const VertexSum::Term& term, VertexSum& sum) {
  const auto& x = term.stretch;
  auto& s = sum.stretch;
  const double w = term.weight;
  s = {s.xx + w * x.xx, s.xy + w * x.xy, s.xz + w * x.xz, s.yy + w * x.yy, s.yz + w * x.yz, s.zz + w * x.zz};
  sum.turn = sum.turn + w * term.turn;
}

}  // namespace

VertexSum vertex_sum(const Weigher& weigher, const Binding& binding, const Mask& mask, const Rows& rows,
                     std::size_t vertex) {
  VertexSum sum;
  // Of stretches without logs, and of moments, no rotation stands beside them.
  sum.has_logs = rows.form == RowForm::logs;
  const auto visit = [&](std::size_t, const std::vector<double>& weights, double share) {
    if (mask) share *= static_cast<double>((*mask)[vertex]);
    for (std::size_t j = 0; j < weights.size(); ++j)
      if (weights[j] != 0) sum.terms.push_back(term_of(rows, sum.has_logs, j, share * weights[j]));
  };
  const std::array<std::size_t, 1> one{vertex};
  if (entry(binding.weighting.weights).on_surface) {
    visit_kept_weights(binding, one,
                       [&](std::size_t i, const std::vector<double>& weights) { visit(i, weights, 1); });
  } else {
    visit_weights(weigher, std::array{binding.rest[vertex]}, visit);
  }
  if (!sum.has_logs)
    for (VertexSum::Term& term : sum.terms)
      term.at = weigher.origin() + weigher.handle_positions()[term.handle];
  std::ranges::stable_sort(sum.terms, [](const VertexSum::Term& a, const VertexSum::Term& b) {
    return std::abs(a.weight) > std::abs(b.weight);
  });
  for (const VertexSum::Term& term : sum.terms) add(term, sum);
  return sum;
}

}  // namespace viete::deform
