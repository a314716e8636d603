#include "sym3/log.h"

#include <algorithm>
#include <cmath>

#include "sym3/double_double.h"
#include "sym3/entries.h"
#include "sym3/jacobi.h"

namespace viete::sym3 {

namespace {

// Jacobi in double errs by some u of the largest eigenvalue: where the smallest is below it by more than this
// factor, that is repeated in double-double.
constexpr double wide = 8;

struct LogOf {
  static double at(double x) { return std::log(x); }
  static double at(const DoubleDouble& x) { return std::log(x.hi) + x.lo / x.hi; }
};

struct Log1pOf {
  static double at(double x) { return std::log1p(x); }
};

struct InvSqrtOf {
  static double at(double x) { return 1 / std::sqrt(x); }
  static double at(const DoubleDouble& x) { return 1 / std::sqrt(x.hi); }
};

/// V f(values) V^T.
template <class F, class Real>
Sym3<double> recompose(const Eigen3<Real>& e) {
  const double f[3] = {F::at(e.values[0]), F::at(e.values[1]), F::at(e.values[2])};
  const auto entry = [&](int i, int j) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      sum += f[k] * jacobi::leading(e.vectors[i][k]) * jacobi::leading(e.vectors[j][k]);
    }
    return sum;
  };
  return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
}

template <class Real>
double smallest(const Eigen3<Real>& e) {
  return std::min({jacobi::leading(e.values[0]), jacobi::leading(e.values[1]), jacobi::leading(e.values[2])});
}

/// A power of two that keeps Jacobi's sums, products and low parts in range; diagonal matrices need none.
double comfortable_scale(const Sym3<double>& s) {
  const double largest = largest_entry(s);
  if (is_diagonal(s)) return 1;
  return largest > 1e250 ? 0x1p-512 : largest < 1e-150 ? 0x1p512 : 1;
}

template <class Real>
Eigen3<Real> eigen_of(const Sym3<double>& s, double scale) {
  auto e = eigen_by_jacobi<Real>(times(s, scale));
  for (Real& x : e.values) x = x * Real{1 / scale};
  return e;
}

/// f(S) for positive definite S, else NaN.
template <class F>
Sym3<double> of_positive(const Sym3<double>& s) {
  const double scale = comfortable_scale(s);
  const auto quick = eigen_of<double>(s, scale);
  const double low = smallest(quick);
  if (!(low > 0) && is_diagonal(s)) return nan_matrix<double>();
  if (low * wide >= largest_entry(s) || is_diagonal(s)) return recompose<F>(quick);
  const auto exact = eigen_of<DoubleDouble>(s, scale);
  return smallest(exact) > 0 ? recompose<F>(exact) : nan_matrix<double>();
}

/// Where S - I is exact, and its eigenvalues keep the digits that those of S would lose.
bool is_near_identity(const Sym3<double>& s) {
  const double off = std::max({std::fabs(s.xy), std::fabs(s.xz), std::fabs(s.yz)});
  const auto [low, high] = std::minmax({s.xx, s.yy, s.zz});
  return low >= 0.75 && high <= 1.5 && off <= 0.2;
}

bool is_usable(const Sym3<double>& s) {
  return is_finite(s) && largest_entry(s) > 0;
}

Sym3<double> log_in_double(const Sym3<double>& s) {
  if (!is_usable(s)) return nan_matrix<double>();
  if (is_near_identity(s)) {
    return recompose<Log1pOf>(eigen_by_jacobi<double>({s.xx - 1, s.xy, s.xz, s.yy - 1, s.yz, s.zz - 1}));
  }
  return of_positive<LogOf>(s);
}

Sym3<double> inv_sqrt_in_double(const Sym3<double>& s) {
  return is_usable(s) ? of_positive<InvSqrtOf>(s) : nan_matrix<double>();
}

}  // namespace

template <class T>
Sym3<T> log(const Sym3<T>& s) {
  return convert<T>(log_in_double(convert<double>(s)));
}

template <class T>
Sym3<T> inv_sqrt(const Sym3<T>& s) {
  return convert<T>(inv_sqrt_in_double(convert<double>(s)));
}

template Sym3<float> log(const Sym3<float>&);
template Sym3<double> log(const Sym3<double>&);
template Sym3<float> inv_sqrt(const Sym3<float>&);
template Sym3<double> inv_sqrt(const Sym3<double>&);

}  // namespace viete::sym3
