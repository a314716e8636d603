#include "deform/place_vertices.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "deform/apply.h"
#include "deform/blend.h"
#include "deform/map_rows.h"
#include "deform/moments.h"
#include "sym3/exp.h"

namespace viete::deform {

namespace {

using Stretch = sym3::Sym3<double>;

double squared_frobenius(const Stretch& m) {
  return m.xx * m.xx + m.yy * m.yy + m.zz * m.zz + 2 * (m.xy * m.xy + m.xz * m.xz + m.yz * m.yz);
}

double relative_difference(const Stretch& a, const Stretch& b) {
  const Stretch d{a.xx - b.xx, a.xy - b.xy, a.xz - b.xz, a.yy - b.yy, a.yz - b.yz, a.zz - b.zz};
  const double difference = std::sqrt(squared_frobenius(d) / squared_frobenius(b));
  return std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference;
}

double worst_difference(std::span<const Stretch> computed, std::span<const Stretch> logs) {
  std::vector<Stretch> exact(logs.size());
  sym3::exp<double>(logs, exact);
  double worst = 0;
  for (std::size_t i = 0; i < logs.size(); ++i)
    worst = std::max(worst, relative_difference(computed[i], exact[i]));
  return worst;
}

double place_logs(const Binding& binding, const Rows& rows, sym3::Method method,
                  std::span<mesh::Point> positions) {
  const std::size_t n = positions.size();
  BlendedLogs sums;
  sums.resize(n);
  blend(binding, rows, 0, n, sums);
  share_sums(binding, binding.shares, 0, n, sums);
  std::vector<Stretch> stretches(n);
  sym3::exp<double>(sums.stretch, stretches, method);
  apply(binding, binding.shares, sums, stretches, rows.origin, 0, n, positions);
  return method == sym3::Method::fast ? 0 : worst_difference(stretches, sums.stretch);
}

double place_others(const Binding& binding, const Rows& rows, sym3::Method method,
                    std::span<mesh::Point> positions) {
  const std::size_t n = positions.size();
  if (has_moments(rows.form)) {
    place_by_moments(binding, binding.shares, rows, 0, n, positions);
    return 0;
  }
  std::vector<double> sums(n * rows.columns());
  blend(binding, rows, 0, n, std::span(sums));
  share_sums(binding, binding.shares, rows.form, 0, n, sums);
  std::vector<Stretch> logs, stretches;
  if (has_stretch_logs(rows.form)) {
    logs.resize(n), stretches.resize(n);
    exponentiate(rows.form, sums, method, 0, n, logs, stretches);
  }
  apply(binding, binding.shares, rows.form, sums, stretches, rows.origin, 0, n, positions);
  return method == sym3::Method::fast ? 0 : worst_difference(stretches, logs);
}

}  // namespace

double place_vertices(const Binding& binding, const Rows& rows, sym3::Method method,
                      std::span<mesh::Point> positions) {
  return rows.form == RowForm::logs ? place_logs(binding, rows, method, positions)
                                    : place_others(binding, rows, method, positions);
}

}  // namespace viete::deform
