#include <algorithm>
#include <cmath>

#include "sym3/double_double.h"
#include "sym3/entries.h"
#include "sym3/fallback.h"
#include "sym3/jacobi.h"

namespace viete::sym3 {

namespace {

// Beyond +-2800 every exponential, times any double, is infinite or zero; a fourth of it is in range.
constexpr double exponent_limit = 2800;

// Larger entries are scaled down for Jacobi, whose sums and products of halves would overflow.
constexpr double large_entry = 1e270, down = 0x1p-64;

/// The eigenvalues are `values` / scale. They stay unscaled until they are differences: only those are in
/// range.
struct Exponents {
  Eigen3<DoubleDouble> eigen;
  double scale;
};

DoubleDouble exponent(const DoubleDouble& value, double scale) {
  const DoubleDouble x = scaled(value, 1 / scale);
  return std::fabs(x.hi) <= exponent_limit ? x : DoubleDouble{std::copysign(exponent_limit, x.hi), 0};
}

double exp_of(const DoubleDouble& x) {
  return std::exp(x.hi) * (1 + x.lo);
}

/// x e^y in four factors, so that e^y alone may be out of range.
double times_exp(double x, const DoubleDouble& y) {
  const double part = std::exp(y.hi / 4);
  for (int k = 0; k < 4; ++k) x *= part;
  return x * (1 + y.lo);
}

/// Entry (i, j) of V exp(values) V^T. Terms that are zero do not count for the common exponent, so that an
/// overflow stays in its own block of the matrix.
double entry(const Exponents& e, int i, int j) {
  const auto& [values, vectors] = e.eigen;
  double weight[3];
  int top = -1;
  for (int k = 0; k < 3; ++k) {
    weight[k] = vectors[i][k].hi * vectors[j][k].hi;
    if (weight[k] != 0 && (top < 0 || values[k].hi > values[top].hi)) top = k;
  }
  if (top < 0) return 0;
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    if (weight[k] != 0) sum += weight[k] * exp_of(exponent(values[k] - values[top], e.scale));
  }
  return times_exp(sum, exponent(values[top], e.scale));
}

Exponents exponents_of(const Sym3<double>& s) {
  const double scale = largest_entry(s) > large_entry ? down : 1;
  return {eigen_by_jacobi<DoubleDouble>(times(s, scale)), scale};
}

Sym3<double> exp_in_double(const Sym3<double>& s) {
  if (!is_finite(s)) return nan_matrix<double>();
  if (is_diagonal(s)) return {std::exp(s.xx), 0, 0, std::exp(s.yy), 0, std::exp(s.zz)};
  const Exponents e = exponents_of(s);
  return {entry(e, 0, 0), entry(e, 0, 1), entry(e, 0, 2), entry(e, 1, 1), entry(e, 1, 2), entry(e, 2, 2)};
}

/// Numbers k <= l of the six pairs of eigenvectors, in the order of Sym3.
constexpr int first_of[] = {0, 0, 0, 1, 1, 2}, second_of[] = {0, 1, 2, 1, 2, 2};

/// (e^x - e^y) / (x - y) over the larger one of both, or over e^x if they are equal: below 1.
double relative_slope(double distance) {
  return distance > 0 ? -std::expm1(-distance) / distance : 1;
}

/// Entry (i, j) of the sum over pairs of eigenvectors of their slope times that part of E; as `entry`.
double slope_entry(const Exponents& e, const Axes& v, const double (&direction)[6], int i, int j) {
  const auto& values = e.eigen.values;
  double weight[6];
  int larger[6], top = -1;
  for (int n = 0; n < 6; ++n) {
    const int k = first_of[n], l = second_of[n];
    larger[n] = values[k].hi > values[l].hi ? k : l;
    weight[n] = direction[n] * (k == l ? v[i][k] * v[j][k] : v[i][k] * v[j][l] + v[i][l] * v[j][k]);
    if (weight[n] != 0 && (top < 0 || values[larger[n]].hi > values[top].hi)) top = larger[n];
  }
  if (top < 0) return 0;
  double sum = 0;
  for (int n = 0; n < 6; ++n) {
    if (weight[n] == 0) continue;
    const double distance = std::fabs((values[first_of[n]] - values[second_of[n]]).hi / e.scale);
    sum += weight[n] * relative_slope(distance) * exp_of(exponent(values[larger[n]] - values[top], e.scale));
  }
  return times_exp(sum, exponent(values[top], e.scale));
}

Sym3<double> derivative_in_double(const Sym3<double>& s, const Sym3<double>& direction) {
  if (!is_finite(s) || !is_finite(direction)) return nan_matrix<double>();
  if (largest_entry(direction) > large_entry)
    return times(derivative_in_double(s, times(direction, down)), 1 / down);
  const Exponents e = exponents_of(s);
  const Axes v = axes_of(e.eigen);
  const auto [xx, xy, xz, yy, yz, zz] = in_axes(v, direction);
  const double parts[6] = {xx, xy, xz, yy, yz, zz};
  const auto at = [&](int i, int j) { return slope_entry(e, v, parts, i, j); };
  return {at(0, 0), at(0, 1), at(0, 2), at(1, 1), at(1, 2), at(2, 2)};
}

}  // namespace

#define VIETE_FOR(T)                                                   \
  void exp_by_jacobi(const T* in, T* out) {                            \
    to_six(exp_in_double(from_six(in)), out);                          \
  }                                                                    \
  void exp_derivative_by_jacobi(const T* in, T* out) {                 \
    to_six(derivative_in_double(from_six(in), from_six(in + 6)), out); \
  }
VIETE_FOR(float)
VIETE_FOR(double)
#undef VIETE_FOR

}  // namespace viete::sym3
