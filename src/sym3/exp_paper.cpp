#include "sym3/exp_paper.h"
#include "sym3/trigonometric.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#include "sym3/eigen.h"
#include "sym3/eigenvalues.h"
#include "sym3/small_matrices.h"

namespace viete::sym3 {

// Equation numbers and sections are the paper's; its misprints are corrected (README.md, "The paper,
// corrected").

namespace {

constexpr double same_eigenvalue = 1e-6;  // the paper's threshold, absolute

/// exp(S) = x I + y S + z S^2.
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

/// Case 2: two distinct eigenvalues. (The paper labels the equal pair 1, 2; it can be any.)
template <class T>
Spectral<T> two_distinct(T a, T b) {
  const T ea = std::exp(a), eb = std::exp(b);
  const T y = (ea - eb) / (a - b);
  return {(a * eb - b * ea) / (a - b), y, 0};
}

/// Case 3: three distinct eigenvalues, Lagrange's interpolation. x = s - t - u; the paper prints s + t + u.
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

/// The switch of section 2.2.
template <class T>
Spectral<T> spectral_form(const std::array<T, 3>& l) {
  const bool s01 = same(l[0], l[1]), s12 = same(l[1], l[2]), s02 = same(l[0], l[2]);
  if (s01 && s12) return {std::exp(l[0]), 0, 0};
  if (s01) return two_distinct(l[0], l[2]);
  if (s12 || s02) return two_distinct(l[0], l[1]);
  return three_distinct(l[0], l[1], l[2]);
}

}  // namespace

template <class T>
int distinct_eigenvalues(const std::array<T, 3>& l) {
  const bool s01 = same(l[0], l[1]), s12 = same(l[1], l[2]), s02 = same(l[0], l[2]);
  return s01 && s12 ? 1 : s01 || s12 || s02 ? 2 : 3;
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

template int distinct_eigenvalues(const std::array<double, 3>&);
template Sym3<float> exp_diag(const Sym3<float>&);
template Sym3<double> exp_diag(const Sym3<double>&);
template Sym3<float> exp_sd(const Sym3<float>&);
template Sym3<double> exp_sd(const Sym3<double>&);
template Sym3<float> exp_improved_sd(const Sym3<float>&);
template Sym3<double> exp_improved_sd(const Sym3<double>&);
template Sym3<float> exp_improved_sd_faithful(const Sym3<float>&);
template Sym3<double> exp_improved_sd_faithful(const Sym3<double>&);

}  // namespace viete::sym3
