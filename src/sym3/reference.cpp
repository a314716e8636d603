#include "sym3/reference.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sym3/double_double.h"
#include "sym3/jacobi.h"
#include "sym3/small_matrices.h"

namespace viete::sym3 {

namespace {

using Real = DoubleDouble;
using Matrix = Sym3<DoubleDouble>;

constexpr int terms = 32;  // 1/32! < 2^-117
constexpr double entry_limit = 1e6;
constexpr double largest_exponent = 2800;  // beyond +- this number, results overflow or underflow

const std::array<Real, terms>& inverse_factorials() {
  static const auto table = [] {
    std::array<Real, terms> t;
    t[0] = {1, 0};
    for (int k = 1; k < terms; ++k) t[k] = t[k - 1] / Real{static_cast<double>(k), 0};
    return t;
  }();
  return table;
}

Matrix scaled(const Matrix& m, double s) {
  return {scaled(m.xx, s), scaled(m.xy, s), scaled(m.xz, s),
          scaled(m.yy, s), scaled(m.yz, s), scaled(m.zz, s)};
}

/// Returns the Taylor polynomial of exp at x, for |x| <= 1.
Real exp_taylor(const Real& x) {
  const auto& a = inverse_factorials();
  Real sum = a[terms - 1];
  for (int k = terms - 2; k >= 0; --k) sum = sum * x + a[k];
  return sum;
}

/// Works like exp_taylor() above, for a matrix with trace zero and a norm up to about 1. Uses the recurrence
/// of exp-inl.h.
Matrix exp_taylor(const Matrix& m) {
  const Matrix c = {m.yy * m.zz - m.yz * m.yz, m.xz * m.yz - m.xy * m.zz, m.xy * m.yz - m.xz * m.yy,
                    m.xx * m.zz - m.xz * m.xz, m.xy * m.xz - m.xx * m.yz, m.xx * m.yy - m.xy * m.xy};
  const Real p = -(c.xx + c.yy + c.zz), q = m.xx * c.xx + m.xy * c.xy + m.xz * c.xz;
  const auto& a = inverse_factorials();
  Real z0{}, z1{}, z2{};
  for (int k = terms - 1; k >= 0; --k) {
    const Real next = a[k] + p * z1 + q * z2;
    z2 = z1, z1 = z0, z0 = next;
  }
  return {z0 + z1 * m.xx + z2 * c.xx, z1 * m.xy + z2 * c.xy, z1 * m.xz + z2 * c.xz,
          z0 + z1 * m.yy + z2 * c.yy, z1 * m.yz + z2 * c.yz, z0 + z1 * m.zz + z2 * c.zz};
}

Real mean_of_diagonal(const Sym3<double>& s) {
  const Real third = Real{1, 0} / Real{3, 0};
  return (Real{s.xx, 0} + Real{s.yy, 0} + Real{s.zz, 0}) * third;
}

/// Returns m * 2^n. Multiplies in four steps, because 2^n as one factor may overflow.
Matrix times_power(Matrix m, int n) {
  const int quarter = n / 4;
  for (int i = 0; i < 3; ++i) m = scaled(m, std::ldexp(1.0, quarter));
  return scaled(m, std::ldexp(1.0, n - 3 * quarter));
}

/// Returns m * e^x, with x = n * ln 2 + r and 160 bits of ln 2.
Matrix times_exp(const Matrix& m, double x) {
  x = std::clamp(x, -largest_exponent, largest_exponent);
  const double n = std::nearbyint(x / 0x1.62e42fefa39efp-1);
  Real r = two_product(-n, 0x1.62e42fefa39efp-1) + Real{x, 0};
  r = r + two_product(-n, 0x1.abc9e3b39803fp-56) + two_product(-n, 0x1.7b57a079a1934p-111);
  return times_power(times(m, exp_taylor(r)), static_cast<int>(n));
}

double frobenius(const Sym3<double>& s) {
  return std::sqrt(s.xx * s.xx + s.yy * s.yy + s.zz * s.zz + 2 * (s.xy * s.xy + s.xz * s.xz + s.yz * s.yz));
}

Matrix traceless(const Sym3<double>& s, const Real& mean) {
  return {Real{s.xx, 0} - mean, Real{s.xy, 0}, Real{s.xz, 0},
          Real{s.yy, 0} - mean, Real{s.yz, 0}, Real{s.zz, 0} - mean};
}

/// Returns exp(S - top I), where `top` is about the largest eigenvalue. The result has a norm of about 1, so
/// squaring cannot overflow.
Matrix exp_below(const Sym3<double>& s, double top) {
  const Real mean = mean_of_diagonal(s);
  const Matrix a = traceless(s, mean);
  const double norm = frobenius({a.xx.hi, s.xy, s.xz, a.yy.hi, s.yz, a.zz.hi});
  const int squarings = std::max(0, std::ilogb(std::max(norm, 0.5)) + 1);
  const double scale = std::ldexp(1.0, -squarings);
  const Real offset = scaled(mean - Real{top, 0}, scale);
  Matrix m = times(exp_taylor(scaled(a, scale)), exp_taylor(offset));
  for (int k = 0; k < squarings; ++k) m = square(m);
  return m;
}

Real tidy(const Real& x) {
  return std::isfinite(x.hi) ? x : Real{x.hi, 0};
}

}  // namespace

Matrix exp_reference(const Sym3<double>& s) {
  constexpr Real nan{std::numeric_limits<double>::quiet_NaN(), 0};
  if (!is_finite(s) || largest_entry(s) > entry_limit) return {nan, nan, nan, nan, nan, nan};
  const auto values = eigen_by_jacobi<double>(s).values;
  const double top = *std::max_element(values.begin(), values.end());
  const Matrix m = times_exp(exp_below(s, top), top);
  return {tidy(m.xx), tidy(m.xy), tidy(m.xz), tidy(m.yy), tidy(m.yz), tidy(m.zz)};
}

double relative_error(const Sym3<double>& computed, const Sym3<double>& s) {
  const Matrix exact = exp_reference(s);
  const double unit = std::max({exact.xx.hi, exact.yy.hi, exact.zz.hi});  // no entry is larger
  const auto error = [unit](double x, const Real& y) { return ((x - y.hi) - y.lo) / unit; };
  const Sym3<double> difference = {error(computed.xx, exact.xx), error(computed.xy, exact.xy),
                                   error(computed.xz, exact.xz), error(computed.yy, exact.yy),
                                   error(computed.yz, exact.yz), error(computed.zz, exact.zz)};
  const Sym3<double> size = {exact.xx.hi / unit, exact.xy.hi / unit, exact.xz.hi / unit,
                             exact.yy.hi / unit, exact.yz.hi / unit, exact.zz.hi / unit};
  return frobenius(difference) / frobenius(size);
}

}  // namespace viete::sym3
