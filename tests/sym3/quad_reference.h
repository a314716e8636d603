// What the tests measure errors against: functions of symmetric matrices in 113 bits, by Jacobi and
// libquadmath.
#pragma once

#include <quadmath.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sym3/double_double.h"
#include "sym3/rotation.h"
#include "sym3/sym3.h"

namespace viete::test {

using Quad = __float128;
using QuadSym = sym3::Sym3<Quad>;

inline Quad to_quad(double x) {
  return x;
}
inline QuadSym to_quad(const sym3::Sym3<double>& s) {
  return {s.xx, s.xy, s.xz, s.yy, s.yz, s.zz};
}
inline QuadSym to_quad(const sym3::Sym3<float>& s) {
  return {s.xx, s.xy, s.xz, s.yy, s.yz, s.zz};
}

inline Quad to_quad(const sym3::DoubleDouble& x) {
  return Quad(x.hi) + Quad(x.lo);
}

/// 1 / sqrt x to 112 bits: one step of Newton's method from 64 (sqrtq takes ten times as long).
inline Quad quad_inverse_root(Quad x) {
  const Quad y = 1 / std::sqrt(static_cast<long double>(x));
  return y + y * (1 - x * y * y) / 2;
}

/// values[k] with the unit vector vectors[.][k].
struct QuadEigen {
  std::array<Quad, 3> values;
  std::array<std::array<Quad, 3>, 3> vectors;
};

inline void quad_rotate(std::array<std::array<Quad, 3>, 3>& a, std::array<std::array<Quad, 3>, 3>& v, int p,
                        int q) {
  if (a[p][q] == 0) return;
  const Quad theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const Quad size = fabsq(theta) + (theta * theta + 1) * quad_inverse_root(theta * theta + 1),
             t = (theta < 0 ? -1 : 1) / size;
  const Quad c = quad_inverse_root(t * t + 1), s = t * c;
  const int r = 3 - p - q;
  const Quad shift = t * a[p][q], x = a[r][p], y = a[r][q];
  a[p][p] -= shift, a[q][q] += shift, a[p][q] = a[q][p] = 0;
  a[r][p] = a[p][r] = c * x - s * y, a[r][q] = a[q][r] = s * x + c * y;
  for (int k = 0; k < 3; ++k) {
    const Quad x = v[k][p], y = v[k][q];
    v[k][p] = c * x - s * y, v[k][q] = s * x + c * y;
  }
}

inline QuadEigen quad_eigen(const QuadSym& s) {
  std::array<std::array<Quad, 3>, 3> a = {{{s.xx, s.xy, s.xz}, {s.xy, s.yy, s.yz}, {s.xz, s.yz, s.zz}}};
  std::array<std::array<Quad, 3>, 3> v = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const Quad tiny = scalbnq(1, -118);
  for (int sweep = 0; sweep < 20; ++sweep) {
    const Quad off = fabsq(a[0][1]) + fabsq(a[0][2]) + fabsq(a[1][2]);
    const Quad least = std::min({fabsq(a[0][0]), fabsq(a[1][1]), fabsq(a[2][2])});
    if (off <= tiny * least) break;
    quad_rotate(a, v, 0, 1), quad_rotate(a, v, 0, 2), quad_rotate(a, v, 1, 2);
  }
  return {{a[0][0], a[1][1], a[2][2]}, v};
}

template <class F>
QuadSym quad_function(const QuadSym& s, F f) {
  const QuadEigen e = quad_eigen(s);
  const std::array<Quad, 3> g = {f(e.values[0]), f(e.values[1]), f(e.values[2])};
  const auto entry = [&](int i, int j) {
    Quad sum = 0;
    for (int k = 0; k < 3; ++k) sum += g[k] * e.vectors[i][k] * e.vectors[j][k];
    return sum;
  };
  return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
}

inline QuadSym quad_exp(const QuadSym& s) {
  return quad_function(s, expq);
}
inline QuadSym quad_log(const QuadSym& s) {
  return quad_function(s, logq);
}
inline QuadSym quad_inv_sqrt(const QuadSym& s) {
  return quad_function(s, [](Quad x) { return 1 / sqrtq(x); });
}

/// Rodrigues' formula.
inline std::array<Quad, 9> quad_rotation(const std::array<Quad, 3>& w) {
  const Quad angle = sqrtq(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
  const Quad half = angle / 2, a = angle > 0 ? sinq(angle) / angle : 1;
  const Quad b = angle > 0 ? 2 * sinq(half) * sinq(half) / (angle * angle) : Quad(1) / 2, c = cosq(angle);
  const auto [x, y, z] = w;
  return {c + b * x * x,     b * x * y - a * z, b * x * z + a * y, b * x * y + a * z, c + b * y * y,
          b * y * z - a * x, b * x * z - a * y, b * y * z + a * x, c + b * z * z};
}

/// To 64 bits, which is plenty for a norm and takes a tenth of the time.
inline Quad quad_frobenius(const QuadSym& s) {
  const auto square = [](Quad x) { return static_cast<long double>(x) * static_cast<long double>(x); };
  return std::sqrt(square(s.xx) + square(s.yy) + square(s.zz) +
                   2 * (square(s.xy) + square(s.xz) + square(s.yz)));
}

/// |x - y|, Frobenius norm.
inline Quad quad_distance(const QuadSym& x, const QuadSym& y) {
  return quad_frobenius({x.xx - y.xx, x.xy - y.xy, x.xz - y.xz, x.yy - y.yy, x.yz - y.yz, x.zz - y.zz});
}

/// u = 2^-53 or 2^-24: half the distance from 1 to the next number.
template <class T>
inline constexpr double unit_roundoff = sizeof(T) == 8 ? 0x1p-53 : 0x1p-24;

/// |computed - exact| / |exact| in units of roundoff of T; NaN if an entry of `computed` is.
template <class T>
double error_in_u(const sym3::Sym3<T>& computed, const QuadSym& exact) {
  return static_cast<double>(quad_distance(to_quad(computed), exact) / quad_frobenius(exact)) /
         unit_roundoff<T>;
}

}  // namespace viete::test
