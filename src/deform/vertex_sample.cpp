#include "deform/vertex_sample.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "deform/staged_engine.h"
#include "pose/deformer.h"
#include "pose/maps.h"
#include "weights/bind.h"
#include "weights/tiled_binding.h"

namespace viete::deform {

VertexSum vertex_sum(const weights::Weigher& weigher, const weights::Binding& binding,
                     const weights::Mask& mask, const pose::Rows& rows, std::size_t vertex) {
  const weights::Binding part =
      bind_vertices(weigher, *binding.rest, known_row(binding), mask, std::array{vertex}).binding;
  const double share = part.shares.empty() ? 1 : part.shares[0];
  VertexSum sum;
  sum.has_logs = rows.form == pose::RowForm::logs;
  for (std::uint32_t j = 0; j < part.handles; ++j) {
    if (part.weights[j] == 0) continue;
    auto& term = sum.terms.emplace_back(VertexSum::Term{j, share * part.weights[j]});
    term.at = weigher.origin() + weigher.handle_positions()[j];
    if (!sum.has_logs) continue;
    const double* x = rows.values.data() + j * pose::log_shape.columns;
    term.stretch = {x[0], x[1], x[2], x[3], x[4], x[5]};
    term.turn = {x[6], x[7], x[8]};
    term.at = rows.origin + Vec3{x[9], x[10], x[11]};
  }
  std::ranges::stable_sort(sum.terms, [](const VertexSum::Term& a, const VertexSum::Term& b) {
    return std::abs(a.weight) > std::abs(b.weight);
  });
  for (const VertexSum::Term& term : sum.terms) {
    sum.stretch = pose::plus(sum.stretch, term.weight, term.stretch);
    sum.turn = sum.turn + term.weight * term.turn;
  }
  return sum;
}

namespace {

void move_by(const ProbeLayer& layer, std::span<const std::size_t> vertices, const Vec3& origin,
             std::span<mesh::Point> positions) {
  for (mesh::Point& p : positions) p = p - origin;
  layer.move(std::vector<std::uint32_t>(vertices.begin(), vertices.end()), positions, sym3::Method::fast);
  for (mesh::Point& p : positions) p = origin + p;
}

}  // namespace

double sampled_error(const weights::Weigher& weigher, const weights::Binding& binding,
                     const weights::Mask& mask, std::span<const Vec3> displacements, const pose::Rows& rows,
                     const ProbeLayer* layer, std::span<const Vec3> shown) {
  const auto vertices = weights::spread_vertices(binding.vertices, weights::error_sample);
  auto exact = mesh::picked(std::span(*binding.rest), vertices);
  const weights::Binding part = bind_part(weigher, exact, binding.tiles->sample).binding;
  const weights::Shares shares = weights::product(part.shares, mesh::picked(weights::values(mask), vertices));
  apply_to_vertices({part, shares, mesh::picked(displacements, vertices)}, rows, sym3::Method::fast, exact);
  if (layer && layer->moves()) move_by(*layer, vertices, rows.origin, exact);
  double worst = 0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    worst = std::max(worst, norm(rows.origin + shown[i] - exact[i]));
  return worst / weigher.cage().diagonal;
}

std::vector<sym3::Sym3<double>> sample_stretches(const weights::Weigher& weigher,
                                                 const weights::Binding& binding, const weights::Mask& mask,
                                                 const pose::Rows& rows, std::size_t limit,
                                                 base::Progress* progress) {
  constexpr std::size_t portion = 256;
  if (rows.form != pose::RowForm::logs) return {};
  const auto vertices = weights::spread_vertices(binding.model_vertices(), limit);
  const weights::KnownRow row = known_row(binding);
  std::vector<sym3::Sym3<double>> sample(vertices.size());
  for (std::size_t begin = 0; begin < vertices.size(); begin += portion) {
    if (progress) progress->report(static_cast<double>(begin) / static_cast<double>(vertices.size()));
    const auto some = std::span(vertices).subspan(begin, std::min(portion, vertices.size() - begin));
    const weights::Binding part = bind_vertices(weigher, *binding.rest, row, mask, some).binding;
    std::vector<double> sums(some.size() * pose::log_shape.columns);
    blend({part, part.shares}, rows, 0, some.size(), sums);
    stretch_logs(sums, 0, some.size(), std::span(sample).subspan(begin));
  }
  return sample;
}

}  // namespace viete::deform
