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

Sym3<double> exp_in_double(const Sym3<double>& s) {
  if (!is_finite(s)) return nan_matrix<double>();
  if (is_diagonal(s)) return {std::exp(s.xx), 0, 0, std::exp(s.yy), 0, std::exp(s.zz)};
  const double scale = largest_entry(s) > large_entry ? down : 1;
  const Exponents e = {eigen_by_jacobi<DoubleDouble>(times(s, scale)), scale};
  return {entry(e, 0, 0), entry(e, 0, 1), entry(e, 0, 2), entry(e, 1, 1), entry(e, 1, 2), entry(e, 2, 2)};
}

template <class T>
void exp_any(const T* in, T* out) {
  const Sym3<double> e = exp_in_double({in[0], in[1], in[2], in[3], in[4], in[5]});
  out[0] = T(e.xx), out[1] = T(e.xy), out[2] = T(e.xz), out[3] = T(e.yy), out[4] = T(e.yz), out[5] = T(e.zz);
}

}  // namespace

void exp_by_jacobi(const double* in, double* out) {
  exp_any(in, out);
}
void exp_by_jacobi(const float* in, float* out) {
  exp_any(in, out);
}

}  // namespace viete::sym3
