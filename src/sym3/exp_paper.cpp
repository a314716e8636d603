// exp of one matrix by the methods of the paper, calls of the kernels for method `fast`, and exp with 106
// bits.
#include "sym3/exp.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "sym3/call_kernel.h"
#include "sym3/eigen.h"
#include "sym3/eigenvalues.h"
#include "sym3/exp_tables.h"
#include "sym3/jacobi.h"
#include "sym3/log.h"
#include "sym3/small_matrices.h"

namespace viete::sym3 {

// Section numbers refer to the paper. Misprints are corrected, see "The paper, corrected" in README.md.

namespace {

/// The form det(x I - S) = (x - shift)^3 + p (x - shift) + q, where p <= 0 up to rounding.
template <class T>
struct DepressedCubic {
  T p, q, shift;
};

/// Converts det(x I - S) = x^3 + a x^2 + b x + c to the form above, as in the paper. If roots are close,
/// cancellation makes p and q inaccurate.
template <class T>
DepressedCubic<T> depressed_cubic(const Sym3<T>& s) {
  const T a = -(s.xx + s.yy + s.zz);
  const T b = s.xx * s.yy + s.yy * s.zz + s.zz * s.xx - s.xy * s.xy - s.yz * s.yz - s.xz * s.xz;
  const T c = s.xx * s.yz * s.yz + s.yy * s.xz * s.xz + s.zz * s.xy * s.xy - s.xx * s.yy * s.zz -
              2 * s.xy * s.yz * s.xz;
  return {b - a * a / 3, c + 2 * a * a * a / 27 - a * b / 3, -a / 3};
}

/// Returns t cos((acos k + 2 pi i) / 3) + shift for i = 0, 1, 2: the largest, smallest and middle root.
template <class T>
std::array<T, 3> viete_cosines(T t, T k, T shift) {
  constexpr T third_turn = 2 * std::numbers::pi_v<T> / 3;
  const T angle = std::acos(k) / 3;
  return {t * std::cos(angle) + shift, t * std::cos(angle + third_turn) + shift,
          t * std::cos(angle + 2 * third_turn) + shift};
}

/// Uses the paper's r = sqrt(-12 p), k = -108 q / r^3 (the appendix misprints k as -4 q / p^3) and t = r / 3.
/// If rounding makes p positive or |k| > 1, or if r = 0, returns NaN.
template <class T>
std::array<T, 3> viete_roots_as_printed(const DepressedCubic<T>& f) {
  const T r = std::sqrt(-12 * f.p);
  return viete_cosines(r / 3, -108 * f.q / (r * r * r), f.shift);
}

/// Works like viete_roots_as_printed(), but clamps k to [-1, 1]. If r^3 is 0 or NaN, returns a triple root.
template <class T>
std::array<T, 3> viete_roots(const DepressedCubic<T>& f) {
  const T r = std::sqrt(std::max(-12 * f.p, T(0)));
  const T r3 = r * r * r;
  if (!(r3 > 0)) return {f.shift, f.shift, f.shift};
  return viete_cosines(r / 3, std::clamp(-108 * f.q / r3, T(-1), T(1)), f.shift);
}

constexpr double same_eigenvalue = 1e-6;  // the paper's threshold, absolute

/// The coefficients of exp(S) = x I + y S + z S^2.
template <class T>
struct Spectral {
  T x, y, z;
};

template <class T>
Sym3<T> evaluate(const Spectral<T>& f, const Sym3<T>& s) {
  const Sym3<T> s2 = square(s);
  return {f.x + f.y * s.xx + f.z * s2.xx, f.y * s.xy + f.z * s2.xy, f.y * s.xz + f.z * s2.xz,
          f.x + f.y * s.yy + f.z * s2.yy, f.y * s.yz + f.z * s2.yz, f.x + f.y * s.zz + f.z * s2.zz};
}

/// Case 2: two distinct eigenvalues. (In the paper eigenvalues 1 and 2 are equal; here any two may be equal.)
template <class T>
Spectral<T> two_distinct(T a, T b) {
  const T ea = std::exp(a), eb = std::exp(b);
  const T y = (ea - eb) / (a - b);
  return {(a * eb - b * ea) / (a - b), y, 0};
}

/// Case 3: three distinct eigenvalues, by Lagrange's interpolation. (The paper misprints x as s + t + u.)
template <class T>
Spectral<T> three_distinct(T a, T b, T c) {
  const T ea = std::exp(a), eb = std::exp(b), ec = std::exp(c);
  const T wa = ea / ((a - b) * (a - c)), wb = eb / ((a - b) * (b - c)), wc = ec / ((c - a) * (b - c));
  const T s = wa * b * c, t = wb * a * c, u = wc * a * b;
  return {s - t - u, -wa * (b + c) + wb * (a + c) + wc * (a + b), wa - wb - wc};
}

template <class T>
bool same(T a, T b) {
  return std::fabs(a - b) < T(same_eigenvalue);
}

/// Chooses the case by the number of distinct eigenvalues (section 2.2).
template <class T>
Spectral<T> spectral_form(const std::array<T, 3>& l) {
  const bool s01 = same(l[0], l[1]), s12 = same(l[1], l[2]), s02 = same(l[0], l[2]);
  if (s01 && s12) return {std::exp(l[0]), 0, 0};
  if (s01) return two_distinct(l[0], l[2]);
  if (s12 || s02) return two_distinct(l[0], l[1]);
  return three_distinct(l[0], l[1], l[2]);
}

int distinct_eigenvalues(const std::array<double, 3>& l) {
  const bool s01 = same(l[0], l[1]), s12 = same(l[1], l[2]), s02 = same(l[0], l[2]);
  return s01 && s12 ? 1 : s01 || s12 || s02 ? 2 : 3;
}

template <class T>
std::array<T, 3> three_nan() {
  constexpr T nan = std::numeric_limits<T>::quiet_NaN();
  return {nan, nan, nan};
}

template <class T>
Sym3<T> exp_diag(const Sym3<T>& s) {
  if (!is_finite(s)) return nan_matrix<T>();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix<T, 3, 3>> solver;
  solver.compute(to_eigen(s));
  const auto& v = solver.eigenvectors();
  const Eigen::Matrix<T, 3, 1> values = solver.eigenvalues().array().exp();
  return from_eigen<T>(v * values.asDiagonal() * v.transpose());
}

template <class T>
Sym3<T> exp_sd(const Sym3<T>& s) {
  if (!is_finite(s)) return nan_matrix<T>();
  return evaluate(spectral_form(eigenvalues_qr(s)), s);
}

template <class T>
Sym3<T> exp_improved_sd(const Sym3<T>& s) {
  if (!is_finite(s)) return nan_matrix<T>();
  return evaluate(spectral_form(viete_roots(depressed_cubic(s))), s);
}

template <class T>
Sym3<T> exp_improved_sd_faithful(const Sym3<T>& s) {
  return evaluate(spectral_form(viete_roots_as_printed(depressed_cubic(s))), s);
}

constexpr MethodEntry table[] = {
    {Method::diag, "diag", "Diag", "Full diagonalisation by QR."},
    {Method::sd, "sd", "SD", "Spectral decomposition with eigenvalues by QR."},
    {Method::improved_sd, "improved_sd", "Improved SD",
     "Spectral decomposition with eigenvalues by Viete's formula."},
    {Method::improved_sd_faithful, "improved_sd_faithful", "ISD unguarded",
     "Improved SD (ISD) without checks: NaN for many matrices with equal eigenvalues."},
    {Method::fast, "fast", "Fast", "A recurrence in two invariants that needs no eigenvalues (default)."},
};

template <class T>
Sym3<T> exp_fast(const Sym3<T>& s) {
  return call_one<Sym3<T>>(&KernelFunctions<T>::exp, &s.xx);
}

template <class T>
auto one_by(Method method) -> Sym3<T> (*)(const Sym3<T>&) {
  switch (method) {
    case Method::diag: return exp_diag<T>;
    case Method::sd: return exp_sd<T>;
    case Method::improved_sd: return exp_improved_sd<T>;
    case Method::improved_sd_faithful: return exp_improved_sd_faithful<T>;
    case Method::fast: break;
  }
  return exp_fast<T>;
}

Route route_of_fast(const Sym3<double>& s) {
  using C = ExpTables<double>;
  Route route{.degree = static_cast<int>(sizeof(C::matrix_exp) / sizeof(double)) - 1};
  const double trace = s.xx + s.yy + s.zz, mean = trace / 3;
  const double x = s.xx - mean, y = s.yy - mean, z = s.zz - mean;
  double p = (x * x + y * y + z * z) / 2 + s.xy * s.xy + s.xz * s.xz + s.yz * s.yz;
  if (p <= C::p_limit && std::abs(trace) <= C::trace_limit) return route;
  for (; p > C::p_limit && route.squarings < C::max_squarings; p /= 4) ++route.squarings;
  if (is_diagonal(s) || !(p <= C::p_limit) || !is_finite(exp_fast(s))) return {.by_jacobi = true};
  return route;
}

}  // namespace

template <class T>
std::array<T, 3> eigenvalues_qr(const Sym3<T>& s) {
  if (!is_finite(s)) return three_nan<T>();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix<T, 3, 3>> solver;
  solver.compute(to_eigen(s), Eigen::EigenvaluesOnly);
  const auto& values = solver.eigenvalues();
  return {values[0], values[1], values[2]};
}

template <class T>
std::array<T, 3> eigenvalues_viete(const Sym3<T>& s) {
  if (!is_finite(s)) return three_nan<T>();
  const auto [largest, smallest, middle] = viete_roots(depressed_cubic(s));
  return {smallest, middle, largest};
}

template <class T>
Sym3<T> log_qr(const Sym3<T>& s) {
  if (!is_finite(s)) return nan_matrix<T>();
  if (has_huge_eigenvalues(s)) return log_of_256_times(log_qr(times(s, T(0x1p-8))));
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix<T, 3, 3>> solver;
  solver.compute(to_eigen(s));
  const auto& v = solver.eigenvectors();
  if (!(solver.eigenvalues().minCoeff() > 0)) return nan_matrix<T>();
  Eigen::Matrix<T, 3, 1> values = solver.eigenvalues().array().log();
  for (int k = 0; k < 3; ++k) {  // Eigen's log changes subnormal numbers to the smallest normal number
    const T value = solver.eigenvalues()[k];
    if (value < std::numeric_limits<T>::min()) values[k] = std::log(value);
  }
  return from_eigen<T>(v * values.asDiagonal() * v.transpose());
}

std::span<const MethodEntry> methods() {
  return table;
}

std::string_view name(Method method) {
  return table[static_cast<std::size_t>(method)].name;
}

std::string_view label(Method method) {
  return table[static_cast<std::size_t>(method)].label;
}

std::optional<Method> method_from_name(std::string_view name) {
  for (const MethodEntry& entry : table) {
    if (entry.name == name) return entry.method;
  }
  return std::nullopt;
}

template <class T>
Sym3<T> exp(const Sym3<T>& s, Method method) {
  if (method == Method::fast) return exp_fast(s);
  return one_by<T>(method)(s);
}

template <class T>
void exp(std::span<const Sym3<T>> in, std::span<Sym3<T>> out, Method method) {
  assert(in.size() == out.size());
  if (method == Method::fast) return exp(packed(in.data()), packed(out.data()), in.size());
  const auto one = one_by<T>(method);
  for (std::size_t i = 0; i < in.size(); ++i) out[i] = one(in[i]);
}

#define VIETE_FOR(T)                                                                                   \
  template Sym3<T> exp(const Sym3<T>&, Method);                                                        \
  template void exp(std::span<const Sym3<T>>, std::span<Sym3<T>>, Method);                             \
  void exp(const SymView<const T>& in, const SymView<T>& out, std::size_t count, const Batch& batch) { \
    call_many(&KernelFunctions<T>::exp, in, out, count, batch);                                        \
  }                                                                                                    \
  template std::array<T, 3> eigenvalues_qr(const Sym3<T>&);                                            \
  template std::array<T, 3> eigenvalues_viete(const Sym3<T>&);                                         \
  template Sym3<T> log_qr(const Sym3<T>&);
VIETE_FOR(float)
VIETE_FOR(double)
#undef VIETE_FOR

Route route(const Sym3<double>& s, Method method) {
  if (method == Method::fast) return route_of_fast(s);
  if (method == Method::diag || !is_finite(s)) return {};
  if (method == Method::sd) return {.distinct = distinct_eigenvalues(eigenvalues_qr(s))};
  const DepressedCubic<double> cubic = depressed_cubic(s);
  const bool guarded = method == Method::improved_sd;
  return {.distinct = distinct_eigenvalues(guarded ? viete_roots(cubic) : viete_roots_as_printed(cubic))};
}

// exp with 106 bits.

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
    z2 = z1;
    z1 = z0;
    z0 = next;
  }
  return {z0 + z1 * m.xx + z2 * c.xx, z1 * m.xy + z2 * c.xy, z1 * m.xz + z2 * c.xz,
          z0 + z1 * m.yy + z2 * c.yy, z1 * m.yz + z2 * c.yz, z0 + z1 * m.zz + z2 * c.zz};
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

/// Returns exp(S - top I), where `top` is about the largest eigenvalue. The result has a norm of about 1, so
/// squaring cannot overflow.
Matrix exp_below(const Sym3<double>& s, double top) {
  const Real third = Real{1, 0} / Real{3, 0};
  const Real mean = (Real{s.xx, 0} + Real{s.yy, 0} + Real{s.zz, 0}) * third;
  const Matrix a = {Real{s.xx, 0} - mean, Real{s.xy, 0}, Real{s.xz, 0},
                    Real{s.yy, 0} - mean, Real{s.yz, 0}, Real{s.zz, 0} - mean};
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
