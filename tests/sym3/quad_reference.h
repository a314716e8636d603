// Computes reference values in 113 bits: functions of matrices, and their derivatives.
#pragma once

#include <quadmath.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "sym3/fallback.h"
#include "sym3/jacobi.h"
#include "sym3/rotation.h"
#include "sym3/sym3.h"

namespace viete::test {

using Quad = __float128;
using QuadSym = sym3::Sym3<Quad>;

inline Quad to_quad(double x) {
  return x;
}
template <class T>
QuadSym to_quad(const sym3::Sym3<T>& s) {
  return {s.xx, s.xy, s.xz, s.yy, s.yz, s.zz};
}
inline Quad to_quad(const sym3::DoubleDouble& x) {
  return Quad(x.hi) + Quad(x.lo);
}

/// Returns 1 / sqrt(x) with 112 bits. Computes with 64 bits, then improves the result by one Newton step.
/// (sqrtq takes ten times as long.)
inline Quad quad_inverse_root(Quad x) {
  const Quad y = 1 / std::sqrt(static_cast<long double>(x));
  return y + y * (1 - x * y * y) / 2;
}

/// Eigenvalues and eigenvectors. The eigenvector of values[k] is column k of `vectors`.
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
  a[p][p] -= shift;
  a[q][q] += shift;
  a[p][q] = a[q][p] = 0;
  a[r][p] = a[p][r] = c * x - s * y;
  a[r][q] = a[q][r] = s * x + c * y;
  for (int k = 0; k < 3; ++k) {
    const Quad x = v[k][p], y = v[k][q];
    v[k][p] = c * x - s * y;
    v[k][q] = s * x + c * y;
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
    quad_rotate(a, v, 0, 1);
    quad_rotate(a, v, 0, 2);
    quad_rotate(a, v, 1, 2);
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

inline std::array<Quad, 9> quad_rotation(const std::array<Quad, 3>& w) {
  const Quad angle = sqrtq(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
  const Quad half = angle / 2, a = angle > 0 ? sinq(angle) / angle : 1;
  const Quad b = angle > 0 ? 2 * sinq(half) * sinq(half) / (angle * angle) : Quad(1) / 2, c = cosq(angle);
  const auto [x, y, z] = w;
  return {c + b * x * x,     b * x * y - a * z, b * x * z + a * y, b * x * y + a * z, c + b * y * y,
          b * y * z - a * x, b * x * z - a * y, b * y * z + a * x, c + b * z * z};
}

/// Returns the Frobenius norm. Long double is accurate enough for a norm, and ten times as fast.
inline Quad quad_frobenius(const QuadSym& s) {
  const auto square = [](Quad x) { return static_cast<long double>(x) * static_cast<long double>(x); };
  return std::sqrt(square(s.xx) + square(s.yy) + square(s.zz) +
                   2 * (square(s.xy) + square(s.xz) + square(s.yz)));
}

inline Quad quad_distance(const QuadSym& x, const QuadSym& y) {
  return quad_frobenius({x.xx - y.xx, x.xy - y.xy, x.xz - y.xz, x.yy - y.yy, x.yz - y.yz, x.zz - y.zz});
}

/// Returns the unit roundoff u of T: half the distance from 1 to the next number.
template <class T>
inline constexpr double unit_roundoff = sizeof(T) == 8 ? 0x1p-53 : 0x1p-24;

/// Returns |computed - exact| / |exact| in u. If an entry of `computed` is NaN, returns NaN.
template <class T>
double error_in_u(const sym3::Sym3<T>& computed, const QuadSym& exact) {
  return static_cast<double>(quad_distance(to_quad(computed), exact) / quad_frobenius(exact)) /
         unit_roundoff<T>;
}

using QuadMat = std::array<Quad, 9>;  // stored by rows

inline constexpr QuadMat quad_identity{1, 0, 0, 0, 1, 0, 0, 0, 1};

/// Returns M^T M.
inline QuadSym gram(const QuadMat& m) {
  const auto entry = [&](int i, int j) { return m[i] * m[j] + m[3 + i] * m[3 + j] + m[6 + i] * m[6 + j]; };
  return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
}

template <class T>
QuadMat to_quad(const sym3::Mat3<T>& m) {
  QuadMat q;
  for (int i = 0; i < 9; ++i) q[i] = m[i];
  return q;
}

inline QuadMat quad_product(const QuadMat& a, const QuadMat& b) {
  QuadMat c{};
  for (int i = 0; i < 9; ++i)
    for (int k = 0; k < 3; ++k) c[i] += a[i / 3 * 3 + k] * b[3 * k + i % 3];
  return c;
}

inline QuadMat quad_combined(const QuadMat& a, const QuadMat& b, Quad of_a, Quad of_b) {
  QuadMat c;
  for (int i = 0; i < 9; ++i) c[i] = of_a * a[i] + of_b * b[i];
  return c;
}

inline QuadMat quad_inverse(const QuadMat& m) {
  QuadMat r;
  for (int i = 0; i < 9; ++i) {
    const int a = (i / 3 + 1) % 3, b = (i / 3 + 2) % 3, c = (i % 3 + 1) % 3, d = (i % 3 + 2) % 3;
    r[i] = m[3 * c + a] * m[3 * d + b] - m[3 * d + a] * m[3 * c + b];
  }
  const Quad determinant = m[0] * r[0] + m[3] * r[1] + m[6] * r[2];
  for (Quad& x : r) x /= determinant;
  return r;
}

inline Quad quad_norm(const QuadMat& m) {
  Quad sum = 0;
  for (const Quad x : m) sum += x * x;
  return sqrtq(sum);
}

/// Returns the square root. Uses the iteration of Denman and Beavers.
inline QuadMat quad_root(const QuadMat& m) {
  QuadMat y = m, z = quad_identity;
  for (int i = 0; i < 100; ++i) {
    const QuadMat next = quad_combined(y, quad_inverse(z), 0.5, 0.5);
    z = quad_combined(z, quad_inverse(y), 0.5, 0.5);
    const bool done = quad_norm(quad_combined(next, y, 1, -1)) <= 1e-31 * quad_norm(y);
    y = next;
    if (done) break;
  }
  return y;
}

/// Returns log(M) = 2^n log(R). R is M after n square roots, and close to I. A short series gives log(R).
inline QuadMat quad_log_general(QuadMat m) {
  int roots = 0;
  const int exponent = ilogbq(quad_norm(m));
  for (Quad& x : m) x = scalbnq(x, -exponent);
  for (; quad_norm(quad_combined(m, quad_identity, 1, -1)) > 1e-3 && roots < 60; ++roots) m = quad_root(m);
  const QuadMat x = quad_combined(m, quad_identity, 1, -1);
  QuadMat power = x, sum{};
  for (int n = 1; n <= 12; ++n) {
    sum = quad_combined(sum, power, 1, (n % 2 ? Quad(1) : Quad(-1)) / n);
    power = quad_product(power, x);
  }
  return quad_combined(sum, quad_identity, scalbnq(1, roots), exponent * M_LN2q);
}

inline QuadMat quad_exp_general(const QuadMat& log) {
  int squarings = 0;
  for (Quad size = quad_norm(log); size > 1e-3; size /= 2) ++squarings;
  const QuadMat x = quad_combined(log, log, scalbnq(1, -squarings), 0);
  QuadMat term = quad_identity, sum = quad_identity;
  for (int n = 1; n <= 12; ++n) {
    term = quad_combined(quad_product(term, x), x, Quad(1) / n, 0);
    sum = quad_combined(sum, term, 1, 1);
  }
  for (int i = 0; i < squarings; ++i) sum = quad_product(sum, sum);
  return sum;
}

inline double distance(const sym3::Mat3<double>& computed, const QuadMat& exact) {
  return static_cast<double>(quad_norm(quad_combined(to_quad(computed), exact, 1, -1)));
}

/// Returns the condition number of f at m, times |f(m)|. This is the largest singular value of the derivative
/// of f, times |m|.
template <class F>
double sensitivity(const F& f, const QuadMat& m) {
  const QuadMat at = f(m);
  const Quad relative = scalbnq(1, -56), step = relative * quad_norm(m);
  double by_entry[9][9];
  for (int k = 0; k < 9; ++k) {
    QuadMat moved = m;
    moved[k] += step;
    const QuadMat change = quad_combined(f(moved), at, 1 / relative, -1 / relative);
    for (int i = 0; i < 9; ++i) by_entry[k][i] = static_cast<double>(change[i]);
  }
  std::array<double, 9> direction{1, .9, .8, -.7, 1.1, .6, .5, -.4, 1.2};
  double largest = 0;
  for (int n = 0; n < 30; ++n) {
    std::array<double, 9> image{}, back{};
    double length = 0;
    for (int k = 0; k < 9; ++k) length = std::hypot(length, direction[k]);
    for (int k = 0; k < 9; ++k)
      for (int i = 0; i < 9; ++i) image[i] += by_entry[k][i] * direction[k] / length;
    largest = 0;
    for (const double x : image) largest = std::hypot(largest, x);
    for (int k = 0; k < 9; ++k)
      for (int i = 0; i < 9; ++i) back[k] += by_entry[k][i] * image[i];
    direction = back;
  }
  return largest;
}

/// Returns (f(x) - f(y)) / (x - y). If x = y, returns f'(x). p is the exponent of pow.
inline Quad quad_slope(sym3::Of f, double p, Quad x, Quad y) {
  const Quad d = x - y;
  const auto expm1_over = [](Quad t) { return t != 0 ? expm1q(t) / t : 1; };
  if (f == sym3::Of::exp) return expq(y) * expm1_over(d);
  if (f == sym3::Of::sqrt) return 1 / (sqrtq(x) + sqrtq(y));
  const Quad of_log = d != 0 ? log1pq(d / y) / d : 1 / y;
  if (f == sym3::Of::log) return of_log;
  return p * of_log * expq(p * logq(y)) * expm1_over(p * of_log * d);
}

struct QuadDerivative {
  QuadSym value;
  Quad norm;  ///< the largest norm of the derivative in a direction of norm 1
};

inline QuadDerivative quad_derivative(sym3::Of f, double p, const QuadSym& s, const QuadSym& direction) {
  const QuadEigen e = quad_eigen(s);
  const auto& v = e.vectors;
  const Quad m[3][3] = {{direction.xx, direction.xy, direction.xz},
                        {direction.xy, direction.yy, direction.yz},
                        {direction.xz, direction.yz, direction.zz}};
  Quad g[3][3] = {}, norm = 0;
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) g[k][l] += v[i][k] * m[i][j] * v[j][l];
      const Quad slope = quad_slope(f, p, e.values[k], e.values[l]);
      g[k][l] *= slope;
      norm = std::max(norm, fabsq(slope));
    }
  const auto entry = [&](int i, int j) {
    Quad sum = 0;
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l) sum += v[i][k] * g[k][l] * v[j][l];
    return sum;
  };
  return {{entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)}, norm};
}

/// Returns the error in u, relative to exact.norm times the norm of the direction.
template <class T>
double derivative_error(const sym3::Sym3<T>& computed, const QuadDerivative& exact,
                        const QuadSym& direction) {
  const Quad size = exact.norm * quad_frobenius(direction);
  return static_cast<double>(quad_distance(to_quad(computed), exact.value) / size) / unit_roundoff<T>;
}

}  // namespace viete::test
