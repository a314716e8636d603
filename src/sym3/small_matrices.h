// Algebra of symmetric and general 3x3 matrices and vectors. Internal. Kernels must not include this file,
// because kernels must not share inline functions with other code.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "sym3/rotation.h"
#include "sym3/sym3.h"

namespace viete::sym3 {

template <class T>
bool is_finite(const Sym3<T>& s) {
  return s.xx * 0 + s.xy * 0 + s.xz * 0 + s.yy * 0 + s.yz * 0 + s.zz * 0 == 0;
}

template <class T>
T largest_entry(const Sym3<T>& s) {
  return std::max(
      {std::fabs(s.xx), std::fabs(s.xy), std::fabs(s.xz), std::fabs(s.yy), std::fabs(s.yz), std::fabs(s.zz)});
}

template <class T>
bool is_diagonal(const Sym3<T>& s) {
  return s.xy == 0 && s.xz == 0 && s.yz == 0;
}

template <class T>
Sym3<T> times(const Sym3<T>& s, T x) {
  return {s.xx * x, s.xy * x, s.xz * x, s.yy * x, s.yz * x, s.zz * x};
}

template <class T>
Sym3<T> square(const Sym3<T>& s) {
  return {s.xx * s.xx + s.xy * s.xy + s.xz * s.xz, s.xx * s.xy + s.xy * s.yy + s.xz * s.yz,
          s.xx * s.xz + s.xy * s.yz + s.xz * s.zz, s.xy * s.xy + s.yy * s.yy + s.yz * s.yz,
          s.xy * s.xz + s.yy * s.yz + s.yz * s.zz, s.xz * s.xz + s.yz * s.yz + s.zz * s.zz};
}

/// Returns true if S is finite and its eigenvalues may overflow. In this case functions compute with S / 256.
template <class T>
bool has_huge_eigenvalues(const Sym3<T>& s) {
  return is_finite(s) && !is_diagonal(s) && largest_entry(s) > std::numeric_limits<T>::max() / 4;
}

/// Returns log(256 S), from log(S).
template <class T>
Sym3<T> log_of_256_times(Sym3<T> log) {
  constexpr T more = T(5.545177444479562475337856971665412545);
  log.xx += more;
  log.yy += more;
  log.zz += more;
  return log;
}

template <class T>
Sym3<double> from_six(const T* in) {
  return {in[0], in[1], in[2], in[3], in[4], in[5]};
}

template <class T>
void to_six(const Sym3<double>& s, T* out) {
  out[0] = T(s.xx);
  out[1] = T(s.xy);
  out[2] = T(s.xz);
  out[3] = T(s.yy);
  out[4] = T(s.yz);
  out[5] = T(s.zz);
}

template <class T>
Sym3<T> nan_matrix() {
  constexpr T nan = std::numeric_limits<T>::quiet_NaN();
  return {nan, nan, nan, nan, nan, nan};
}

inline Mat3<double> nine_nan() {
  Mat3<double> m;
  m.fill(std::numeric_limits<double>::quiet_NaN());
  return m;
}

inline Mat3<double> full(const Sym3<double>& s) {
  return {s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz};
}

/// Returns the antisymmetric matrix whose product with a vector is the cross product of w and that vector.
inline Mat3<double> cross_matrix(const Vec3<double>& w) {
  return {0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0};
}

inline Mat3<double> product(const Mat3<double>& a, const Mat3<double>& b) {
  Mat3<double> c{};
  for (std::size_t i = 0; i < 9; ++i) {
    for (std::size_t k = 0; k < 3; ++k) c[i] += a[i / 3 * 3 + k] * b[3 * k + i % 3];
  }
  return c;
}

inline Vec3<double> product(const Mat3<double>& m, const Vec3<double>& x) {
  return {m[0] * x[0] + m[1] * x[1] + m[2] * x[2], m[3] * x[0] + m[4] * x[1] + m[5] * x[2],
          m[6] * x[0] + m[7] * x[1] + m[8] * x[2]};
}

template <std::size_t N>
std::array<double, N> times(double s, std::array<double, N> a) {
  for (double& x : a) x *= s;
  return a;
}

/// Returns a + s * b for matrices or vectors.
template <std::size_t N>
std::array<double, N> plus(std::array<double, N> a, double s, const std::array<double, N>& b) {
  for (std::size_t i = 0; i < N; ++i) a[i] += s * b[i];
  return a;
}

template <std::size_t N>
double dot(const std::array<double, N>& a, const std::array<double, N>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Returns the Euclidean norm of a vector, or the Frobenius norm of a matrix.
template <std::size_t N>
double norm(const std::array<double, N>& a) {
  return std::sqrt(dot(a, a));
}

inline Vec3<double> cross(const Vec3<double>& a, const Vec3<double>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double trace(const Mat3<double>& m) {
  return m[0] + m[4] + m[8];
}

inline double determinant(const Mat3<double>& m) {
  return m[0] * (m[4] * m[8] - m[5] * m[7]) + m[1] * (m[5] * m[6] - m[3] * m[8]) +
         m[2] * (m[3] * m[7] - m[4] * m[6]);
}

/// Returns the rotation of a quaternion w, x, y, z of any length. The result is NaN if the length is 0.
template <class T>
Mat3<double> rotation_of_quaternion(const std::array<T, 4>& quaternion) {
  const double w = quaternion[0], x = quaternion[1], y = quaternion[2], z = quaternion[3];
  const double s = 2 / (w * w + x * x + y * y + z * z);
  return {1 - s * (y * y + z * z), s * (x * y - w * z),     s * (x * z + w * y),
          s * (x * y + w * z),     1 - s * (x * x + z * z), s * (y * z - w * x),
          s * (x * z - w * y),     s * (y * z + w * x),     1 - s * (x * x + y * y)};
}

/// Solves A X = B for X by elimination with pivoting. B and X are stored by rows. If A is singular, X is not
/// finite.
template <std::size_t N>
std::array<std::array<double, N>, 3> solved(Mat3<double> a, std::array<std::array<double, N>, 3> b) {
  std::array<std::size_t, 3> row{0, 1, 2};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = k + 1; i < 3; ++i) {
      if (std::abs(a[3 * row[i] + k]) > std::abs(a[3 * row[k] + k])) std::swap(row[i], row[k]);
    }
    for (std::size_t i = k + 1; i < 3; ++i) {
      const double factor = a[3 * row[i] + k] / a[3 * row[k] + k];
      for (std::size_t c = k + 1; c < 3; ++c) a[3 * row[i] + c] -= factor * a[3 * row[k] + c];
      for (std::size_t c = 0; c < N; ++c) b[row[i]][c] -= factor * b[row[k]][c];
    }
  }
  std::array<std::array<double, N>, 3> x;
  for (std::size_t k = 3; k-- > 0;)
    for (std::size_t c = 0; c < N; ++c) {
      double sum = b[row[k]][c];
      for (std::size_t j = k + 1; j < 3; ++j) sum -= a[3 * row[k] + j] * x[j][c];
      x[k][c] = sum / a[3 * row[k] + k];
    }
  return x;
}

}  // namespace viete::sym3
