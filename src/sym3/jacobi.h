// Eigenvalues and eigenvectors by Jacobi rotations: accurate, but too slow for batches. Arithmetic with about
// 106 bits on sums of two doubles. Internal.
#pragma once

#include <array>
#include <cmath>

#include "sym3/sym3.h"

namespace viete::sym3 {

/// Returns exactly a + b. Requires |a| >= |b| or a = 0.
inline DoubleDouble quick_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// Returns exactly a + b.
inline DoubleDouble two_sum(double a, double b) {
  const double sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

/// Splits `a` into two parts of at most 26 bits (Veltkamp). |a| must be below 2^996.
inline DoubleDouble halves(double a) {
  const double shifted = a * 0x1.0000002p27, hi = shifted - (shifted - a);
  return {hi, a - hi};
}

/// Returns the exact product a * b. Overflow and underflow are not handled.
inline DoubleDouble two_product(double a, double b) {
  const double product = a * b;
  const DoubleDouble x = halves(a), y = halves(b);
  return {product, ((x.hi * y.hi - product) + x.hi * y.lo + x.lo * y.hi) + x.lo * y.lo};
}

inline DoubleDouble operator-(const DoubleDouble& a) {
  return {-a.hi, -a.lo};
}

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  DoubleDouble high = two_sum(a.hi, b.hi);
  const DoubleDouble low = two_sum(a.lo, b.lo);
  high = quick_two_sum(high.hi, high.lo + low.hi);
  return quick_two_sum(high.hi, high.lo + low.lo);
}

inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
  return a + -b;
}

inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble product = two_product(a.hi, b.hi);
  return quick_two_sum(product.hi, product.lo + (a.hi * b.lo + a.lo * b.hi));
}

inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double first = a.hi / b.hi;
  const DoubleDouble rest = a - b * DoubleDouble{first, 0};
  const double second = rest.hi / b.hi;
  const DoubleDouble rest2 = rest - b * DoubleDouble{second, 0};
  return quick_two_sum(first, second) + DoubleDouble{rest2.hi / b.hi, 0};
}

/// Returns the root: std::sqrt, improved by one step of Newton's method (Karp and Markstein 1997).
inline DoubleDouble sqrt(const DoubleDouble& a) {
  if (a.hi == 0) return {};
  const double root = std::sqrt(a.hi);
  const DoubleDouble rest = a - two_product(root, root);
  return quick_two_sum(root, rest.hi / (2 * root));
}

inline DoubleDouble scaled(const DoubleDouble& a, double power_of_two) {
  return {a.hi * power_of_two, a.lo * power_of_two};
}

/// The eigenvector of values[k] is column k of `vectors`. The values are not sorted.
template <class Real>
struct Eigen3 {
  std::array<Real, 3> values;
  std::array<std::array<Real, 3>, 3> vectors;
};

namespace jacobi {

template <class Real>
using Rows = std::array<std::array<Real, 3>, 3>;

constexpr int max_sweeps = 16;  // usually five are enough for double and six for double-double

inline double leading(double x) {
  return x;
}
inline double leading(const DoubleDouble& x) {
  return x.hi;
}

/// If |a_pq| is at most this number times sqrt(|a_pp a_qq|), the entry a_pq changes no digit of the result.
constexpr double negligible(double) {
  return 0x1p-56;
}
constexpr double negligible(const DoubleDouble&) {
  return 0x1p-110;
}

template <class Real>
bool is_negligible(const Rows<Real>& a, int p, int q) {
  return std::fabs(leading(a[p][q])) <=
         negligible(Real{}) * std::sqrt(std::fabs(leading(a[p][p]))) * std::sqrt(std::fabs(leading(a[q][q])));
}

template <class Real>
bool is_diagonal(const Rows<Real>& a) {
  return is_negligible(a, 0, 1) && is_negligible(a, 0, 2) && is_negligible(a, 1, 2);
}

/// Returns the tangent of the smaller rotation angle that makes entry (p, q) zero.
template <class Real>
Real tangent(const Real& app, const Real& aqq, const Real& apq) {
  using std::sqrt;
  const double size = std::fabs((leading(aqq) - leading(app)) / leading(apq));
  if (size > 1e40) return size > 1e290 ? Real{} : apq / (aqq - app);
  const Real theta = (aqq - app) / (apq + apq);
  const Real root = sqrt(Real{1} + theta * theta);
  return Real{1} / (leading(theta) < 0 ? theta - root : theta + root);
}

template <class Real>
void rotate(Rows<Real>& a, Rows<Real>& v, int p, int q) {
  using std::sqrt;
  if (leading(a[p][q]) == 0) return;
  const Real t = tangent(a[p][p], a[q][q], a[p][q]);
  const Real c = Real{1} / sqrt(Real{1} + t * t), s = t * c;
  const auto turn = [&](Real& x, Real& y) {
    const Real old = x;
    x = c * old - s * y;
    y = s * old + c * y;
  };
  const int r = 3 - p - q;
  a[p][p] = a[p][p] - t * a[p][q];
  a[q][q] = a[q][q] + t * a[p][q];
  a[p][q] = a[q][p] = Real{};
  turn(a[r][p], a[r][q]);
  a[p][r] = a[r][p];
  a[q][r] = a[r][q];
  for (auto& row : v) turn(row[p], row[q]);
}

}  // namespace jacobi

/// Computes eigenvalues and eigenvectors by the cyclic Jacobi method (Golub and Van Loan, Matrix
/// Computations, 8.5). Real is double or DoubleDouble. If S has diagonal blocks, the vectors have exactly
/// these blocks. Entries must be finite and at most 1e290 in size.
template <class Real>
Eigen3<Real> eigen_by_jacobi(const Sym3<double>& s) {
  using namespace jacobi;
  Rows<Real> a = {{{Real{s.xx}, Real{s.xy}, Real{s.xz}},
                   {Real{s.xy}, Real{s.yy}, Real{s.yz}},
                   {Real{s.xz}, Real{s.yz}, Real{s.zz}}}};
  Rows<Real> v = {{{Real{1}, Real{}, Real{}}, {Real{}, Real{1}, Real{}}, {Real{}, Real{}, Real{1}}}};
  for (int sweep = 0; sweep < max_sweeps && !is_diagonal(a); ++sweep) {
    rotate(a, v, 0, 1);
    rotate(a, v, 0, 2);
    rotate(a, v, 1, 2);
  }
  return {{a[0][0], a[1][1], a[2][2]}, v};
}

/// Returns V f(values) V^T with f = `at`. Skips zero terms, so that an infinity stays in its diagonal block.
template <class F, class Real>
Sym3<double> recompose(const F& at, const Eigen3<Real>& e) {
  const double f[3] = {at(e.values[0]), at(e.values[1]), at(e.values[2])};
  const auto entry = [&](int i, int j) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double weight = jacobi::leading(e.vectors[i][k]) * jacobi::leading(e.vectors[j][k]);
      if (weight != 0) sum += f[k] * weight;
    }
    return sum;
  };
  return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
}

using Axes = std::array<std::array<double, 3>, 3>;

template <class Real>
Axes axes_of(const Eigen3<Real>& eigen) {
  Axes v;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) v[i][k] = jacobi::leading(eigen.vectors[i][k]);
  }
  return v;
}

inline Axes transposed(const Axes& v) {
  return {{{v[0][0], v[1][0], v[2][0]}, {v[0][1], v[1][1], v[2][1]}, {v[0][2], v[1][2], v[2][2]}}};
}

/// Returns V^T E V, where V is `v` and E is `e`.
inline Sym3<double> in_axes(const Axes& v, const Sym3<double>& e) {
  Axes ev;
  for (int k = 0; k < 3; ++k) {
    ev[0][k] = e.xx * v[0][k] + e.xy * v[1][k] + e.xz * v[2][k];
    ev[1][k] = e.xy * v[0][k] + e.yy * v[1][k] + e.yz * v[2][k];
    ev[2][k] = e.xz * v[0][k] + e.yz * v[1][k] + e.zz * v[2][k];
  }
  const auto entry = [&](int k, int l) {
    return v[0][k] * ev[0][l] + v[1][k] * ev[1][l] + v[2][k] * ev[2][l];
  };
  return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
}

}  // namespace viete::sym3
