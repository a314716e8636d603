#include "deform/apply.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "deform/linear_map.h"
#include "deform/map_rows.h"
#include "sym3/general.h"
#include "sym3/translation_log.h"

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

sym3::Mat3<double> nine(Sums s) {
  return {s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7], s[8]};
}

// S o, of S - I.
Vec3 stretched(Sums s, const Vec3& o) {
  return o + times(sym3::Sym3<double>{s[0], s[1], s[2], s[3], s[4], s[5]}, o);
}

// Rotated by a quaternion of any length, given as w - 1, x, y, z; by none if it is 0, as where opposite ones
// cancel.
Vec3 rotated(Sums s, const Vec3& u) {
  const double w = 1 + s[0];
  const Vec3 v = three(s, 1);
  const double square = w * w + squared_norm(v);
  if (!(square > 0)) return u;
  const Vec3 t = (2 / square) * cross(v, u);
  return u + w * t + cross(v, t);
}

// u of sym3/translation_log.h, from L times a vector, and E - I times one.
template <class Turned, class Stretched>
Vec3 translation(const Vec3& a, const Vec3& center, const Vec3& m, const Turned& l, const Stretched& e) {
  const Vec3 way = center - m;
  return a - (way + e(way)) + 0.5 * l(center + m);
}

Vec3 moved_by_screw(Sums s, const Vec3& x, const Vec3& o, const Vec3& stretched) {
  const Vec3 turn = three(s, 6), center = three(s, 18);
  const sym3::Sym3<double> e{s[9], s[10], s[11], s[12], s[13], s[14]};
  const Vec3 u = translation(
      three(s, 15), center, x - o, [&](const Vec3& v) { return cross(turn, v); },
      [&](const Vec3& v) { return times(e, v); });
  const Vec3 way = sym3::phi_times(turn, cross(turn, stretched) + u);
  return center + (stretched + way);
}

Vec3 moved_by_affine_log(Sums s, const Vec3& x, const Vec3& o) {
  const auto l = nine(s), e = nine(s.subspan(9));
  const Vec3 center = three(s, 21);
  const Vec3 u = translation(
      three(s, 18), center, x - o, [&](const Vec3& v) { return times(l, v); },
      [&](const Vec3& v) { return times(e, v); });
  const Vec3 way = sym3::phi_times(l, times(l, o) + u);
  return center + (o + way);
}

// Relative to the pose's origin; stretched_offset: exp(X) o, of forms that have X.
Vec3 moved(RowForm form, Sums s, const Vec3& x, const Vec3& o, const Vec3& stretched_offset) {
  switch (form) {
    case RowForm::logs: break;
    case RowForm::maps: return x + (times(nine(s), x) + three(s, 9));
    case RowForm::positions: return three(s, 0) + o;
    case RowForm::stretches: return times(sym3::exp_rotation(three(s, 6)), stretched(s, o)) + three(s, 9);
    case RowForm::quaternions: return rotated(s.subspan(6, 4), stretched(s, o)) + three(s, 10);
    case RowForm::matrix_logs: return times(sym3::exp_general(nine(s)), o) + three(s, 9);
    case RowForm::screws: return moved_by_screw(s, x, o, stretched_offset);
    case RowForm::affine_logs: return moved_by_affine_log(s, x, o);
    case RowForm::affine_moments:
    case RowForm::similar_moments:
    case RowForm::rigid_moments: break;
  }
  assert(false);  // these go the way of place_by_moments()
  return x;
}

}  // namespace

void apply(const Binding& binding, const Shares& shares, RowForm form, Sums sums,
           std::span<const sym3::Sym3<double>> stretches, const Vec3& origin, std::size_t begin,
           std::size_t end, std::span<mesh::Point> positions) {
  const std::size_t columns = shape(form).columns;
  if (form == RowForm::logs) {  // where x is not needed
    for (std::size_t i = begin; i < end; ++i) {
      const Sums s = sums.subspan(i * columns, columns);
      const Vec3 stretched = times(stretches[i], offset_of(binding, shares, i));
      positions[i] = origin + (times(sym3::exp_rotation(three(s, 6)), stretched) + three(s, 9));
    }
    return;
  }
  const bool stretches_offsets = has_stretch_logs(form);
  for (std::size_t i = begin; i < end; ++i) {
    const Vec3 x = binding.rest[i] - binding.rest_origin, o = offset_of(binding, shares, i);
    const Vec3 stretched_offset = stretches_offsets ? times(stretches[i], o) : o;
    positions[i] = origin + moved(form, sums.subspan(i * columns, columns), x, o, stretched_offset);
  }
}

void stretch_logs(RowForm form, Sums sums, std::size_t begin, std::size_t end,
                  std::span<sym3::Sym3<double>> logs) {
  const std::size_t columns = shape(form).columns;
  for (std::size_t i = begin; i < (has_stretch_logs(form) ? end : begin); ++i) {
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
  std::vector<Stretch> logs(has_stretch_logs(form) ? n : 0), stretches(logs.size());
  stretch_logs(form, sums, 0, n, logs);
  sym3::exp<double>(logs, stretches, method);
  apply(binding, binding.shares, form, sums, stretches, origin, 0, n, positions);
  return error && method != sym3::Method::fast ? worst_difference(stretches, logs) : 0;
}

}  // namespace viete::deform
