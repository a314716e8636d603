#include "deform/apply.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "deform/linear_map.h"

namespace viete::deform {

namespace {

Vec3 offset_of(const Binding& binding, const Shares& shares, std::size_t i) {
  return shares.empty() ? binding.offsets[i] : shares[i] * binding.offsets[i];
}

// Where a vertex is at rest, as far as it stays there.
Vec3 staying(const Binding& binding, double share, std::size_t i) {
  return (1 - share) * (binding.rest[i] - binding.rest_origin);
}

}  // namespace

void share_sums(const Binding& binding, const Shares& shares, RowForm form, std::size_t begin,
                std::size_t end, std::span<double> sums) {
  const std::size_t columns = shape(form).columns, center = shape(form).center;
  for (std::size_t i = begin; i < (shares.empty() ? begin : end); ++i) {
    const auto of = sums.subspan(i * columns, columns);
    for (double& sum : of) sum *= shares[i];
    const Vec3 rest = staying(binding, shares[i], i);
    for (std::size_t c = center; c < columns; ++c) of[c] += rest[c - center];
  }
}

namespace {

using Sums = std::span<const double>;

Vec3 three(Sums s, std::size_t first) {
  return {s[first], s[first + 1], s[first + 2]};
}

}  // namespace

void apply(const Binding& binding, const Shares& shares, RowForm form, Sums sums,
           std::span<const sym3::Sym3<double>> stretches, const Vec3& origin, std::size_t begin,
           std::size_t end, std::span<mesh::Point> positions) {
  const std::size_t columns = shape(form).columns;
  for (std::size_t i = begin; i < end; ++i) {
    const Sums s = sums.subspan(i * columns, columns);
    Vec3 moved;
    if (form == RowForm::maps) {
      const Vec3 x = binding.rest[i] - binding.rest_origin;
      moved = x + (times(sym3::Mat3<double>{s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7], s[8]}, x) +
                   three(s, 9));
    } else if (form == RowForm::positions) {
      moved = three(s, 0) + offset_of(binding, shares, i);
    } else {
      assert(form == RowForm::logs);  // moments go the way of place_by_moments()
      const Vec3 stretched = times(stretches[i], offset_of(binding, shares, i));
      moved = times(sym3::exp_rotation(three(s, 6)), stretched) + three(s, 9);
    }
    positions[i] = origin + moved;
  }
}

void stretch_logs(RowForm form, Sums sums, std::size_t begin, std::size_t end,
                  std::span<sym3::Sym3<double>> logs) {
  const std::size_t columns = shape(form).columns;
  for (std::size_t i = begin; i < (form == RowForm::logs ? end : begin); ++i) {
    const double* x = sums.data() + i * columns;
    logs[i] = {x[0], x[1], x[2], x[3], x[4], x[5]};
  }
}

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

}  // namespace

double place_sums(const Binding& binding, RowForm form, Sums sums, const Vec3& origin, sym3::Method method,
                  std::span<mesh::Point> positions, bool error) {
  const std::size_t n = positions.size();
  std::vector<Stretch> logs(form == RowForm::logs ? n : 0), stretches(logs.size());
  stretch_logs(form, sums, 0, n, logs);
  sym3::exp<double>(logs, stretches, method);
  apply(binding, binding.shares, form, sums, stretches, origin, 0, n, positions);
  return error && method != sym3::Method::fast ? worst_difference(stretches, logs) : 0;
}

}  // namespace viete::deform
