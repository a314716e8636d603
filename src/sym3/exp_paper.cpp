#include "sym3/exp_paper.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "sym3/call_kernel.h"
#include "sym3/eigen.h"
#include "sym3/eigenvalues.h"
#include "sym3/exp_tables.h"
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
std::array<T, 3> eigenvalues(const Sym3<T>& s) {
  return call_one<std::array<T, 3>>(&KernelFunctions<T>::eigenvalues, &s.xx);
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

#define VIETE_FOR(T)                                                                     \
  template std::array<T, 3> eigenvalues(const Sym3<T>&);                                 \
  template std::array<T, 3> eigenvalues_qr(const Sym3<T>&);                              \
  template std::array<T, 3> eigenvalues_viete(const Sym3<T>&);                           \
  template Sym3<T> exp_diag(const Sym3<T>&);                                             \
  template Sym3<T> exp_sd(const Sym3<T>&);                                               \
  template Sym3<T> exp_improved_sd(const Sym3<T>&);                                      \
  template Sym3<T> exp_improved_sd_faithful(const Sym3<T>&);                             \
  void eigenvalues(const SymView<const T>& in, const VecView<T>& out, std::size_t count, \
                   const Batch& batch) {                                                 \
    call_many(&KernelFunctions<T>::eigenvalues, in, out, count, batch);                  \
  }
VIETE_FOR(float)
VIETE_FOR(double)
#undef VIETE_FOR

int distinct_by_qr(const Sym3<double>& s) {
  return distinct_eigenvalues(eigenvalues_qr(s));
}

int distinct_by_viete(const Sym3<double>& s, bool as_printed) {
  const DepressedCubic<double> cubic = depressed_cubic(s);
  return distinct_eigenvalues(as_printed ? viete_roots_as_printed(cubic) : viete_roots(cubic));
}

}  // namespace viete::sym3
