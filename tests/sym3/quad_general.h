// exp and log of general matrices in 113 bits, by roots, squarings and series; and how well conditioned they
// are.
#pragma once

#include <array>
#include <cmath>

#include "sym3/quad_reference.h"

namespace viete::test {

using QuadMat = std::array<Quad, 9>;  // by rows

inline constexpr QuadMat quad_identity{1, 0, 0, 0, 1, 0, 0, 0, 1};

template <class T>
QuadMat to_quad(const sym3::Mat3<T>& m) {
  QuadMat q;
  for (int i = 0; i < 9; ++i) q[i] = m[i];
  return q;
}

inline QuadMat quad_product(const QuadMat& a, const QuadMat& b) {
  QuadMat c{};
  for (int i = 0; i < 9; ++i) {
    for (int k = 0; k < 3; ++k) c[i] += a[i / 3 * 3 + k] * b[3 * k + i % 3];
  }
  return c;
}

inline QuadMat quad_combined(const QuadMat& a, const QuadMat& b, Quad of_a, Quad of_b) {
  QuadMat c;
  for (int i = 0; i < 9; ++i) c[i] = of_a * a[i] + of_b * b[i];
  return c;
}

/// The rows are cross products of columns over the determinant.
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

/// By Denman and Beavers.
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

/// 2^n times that of the root that is so near to I that some terms do, of entries about 1.
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

/// |computed - exact|, Frobenius norm.
inline double distance(const sym3::Mat3<double>& computed, const QuadMat& exact) {
  return static_cast<double>(quad_norm(quad_combined(to_quad(computed), exact, 1, -1)));
}

/// The largest change of f per relative change of the matrix, Frobenius norms: of differences the largest
/// singular value, by power iteration.
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
  std::array<double, 9> way{1, .9, .8, -.7, 1.1, .6, .5, -.4, 1.2};
  double largest = 0;
  for (int n = 0; n < 30; ++n) {
    std::array<double, 9> image{}, back{};
    double length = 0;
    for (int k = 0; k < 9; ++k) length = std::hypot(length, way[k]);
    for (int k = 0; k < 9; ++k) {
      for (int i = 0; i < 9; ++i) image[i] += by_entry[k][i] * way[k] / length;
    }
    largest = 0;
    for (const double x : image) largest = std::hypot(largest, x);
    for (int k = 0; k < 9; ++k) {
      for (int i = 0; i < 9; ++i) back[k] += by_entry[k][i] * image[i];
    }
    way = back;
  }
  return largest;
}

}  // namespace viete::test
