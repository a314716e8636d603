// Products and sizes of general 3x3 matrices and vectors. Internal; not for the kernels, which share no
// inline code.
#pragma once

#include <cmath>
#include <numeric>

#include "sym3/rotation.h"
#include "sym3/sym3.h"

namespace viete::sym3 {

inline Mat3<double> full(const Sym3<double>& s) {
  return {s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz};
}

/// With product(cross_matrix(w), x) = w x x.
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

/// a + s b, of matrices or vectors.
template <std::size_t N>
std::array<double, N> plus(std::array<double, N> a, double s, const std::array<double, N>& b) {
  for (std::size_t i = 0; i < N; ++i) a[i] += s * b[i];
  return a;
}

template <std::size_t N>
double dot(const std::array<double, N>& a, const std::array<double, N>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Of a matrix: Frobenius.
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

}  // namespace viete::sym3
