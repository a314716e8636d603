// log, square roots and eigenvalues by Jacobi's eigenvectors.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sym3/double_double.h"
#include "sym3/entries.h"
#include "sym3/fallback.h"
#include "sym3/jacobi.h"

namespace viete::sym3 {

namespace {

// Jacobi in double errs by some u of the largest eigenvalue: where the smallest is below it by more than this
// factor, that is repeated in double-double.
constexpr double wide = 8;

struct LogOf {
  double operator()(double x) const { return std::log(x); }
  double operator()(const DoubleDouble& x) const { return std::log(x.hi) + x.lo / x.hi; }
};

struct Log1pOf {
  double operator()(double x) const { return std::log1p(x); }
};

struct InvSqrtOf {
  double operator()(double x) const { return 1 / std::sqrt(x); }
  double operator()(const DoubleDouble& x) const { return (*this)(x.hi); }
};

/// What rounding made negative counts as zero.
struct SqrtOf {
  double operator()(double x) const { return x > 0 ? std::sqrt(x) : 0; }
  double operator()(const DoubleDouble& x) const { return (*this)(x.hi); }
};

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

/// f(S) for S all of whose eigenvalues are above `least` times its largest entry, else NaN.
template <class F>
Sym3<double> of_spectrum_above(double least, const F& f, const Sym3<double>& s) {
  const double scale = comfortable_scale(s), bound = least * largest_entry(s);
  const auto quick = eigen_of<double>(s, scale);
  const double low = smallest(quick);
  if (is_diagonal(s)) return low > bound ? recompose(f, quick) : nan_matrix<double>();
  if (low * wide >= largest_entry(s)) return recompose(f, quick);
  const auto exact = eigen_of<DoubleDouble>(s, scale);
  return smallest(exact) > bound ? recompose(f, exact) : nan_matrix<double>();
}

template <class F>
Sym3<double> of_positive(const F& f, const Sym3<double>& s) {
  return of_spectrum_above(0, f, s);
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
  if (has_huge_eigenvalues(s)) return log_of_256_times(log_in_double(times(s, 0x1p-8)));
  if (is_near_identity(s)) {
    return recompose(Log1pOf(), eigen_by_jacobi<double>({s.xx - 1, s.xy, s.xz, s.yy - 1, s.yz, s.zz - 1}));
  }
  return of_positive(LogOf(), s);
}

Sym3<double> inv_sqrt_in_double(const Sym3<double>& s) {
  if (has_huge_eigenvalues(s)) return times(inv_sqrt_in_double(times(s, 0x1p-8)), 0x1p-4);
  return is_usable(s) ? of_positive(InvSqrtOf(), s) : nan_matrix<double>();
}

/// An eigenvalue this far below zero, relative to the largest entry, is rounding in the entries of S.
template <class T>
constexpr double rounding = -8 * static_cast<double>(std::numeric_limits<T>::epsilon());

template <class T>
Sym3<double> sqrt_in_double(const Sym3<double>& s) {
  if (!is_finite(s)) return nan_matrix<double>();
  if (has_huge_eigenvalues(s)) return times(sqrt_in_double<T>(times(s, 0x1p-8)), 0x1p4);
  return largest_entry(s) > 0 ? of_spectrum_above(rounding<T>, SqrtOf(), s) : Sym3<double>{};
}

std::array<double, 3> eigenvalues_in_double(const Sym3<double>& s) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (!is_finite(s)) return {nan, nan, nan};
  const double scale = comfortable_scale(s);
  auto values = eigen_by_jacobi<double>(times(s, scale)).values;
  for (double& x : values) x /= scale;
  std::sort(values.begin(), values.end());
  return values;
}

/// (f(x) - f(y)) / (x - y), or f'(x) where they are equal, for positive x >= y.
struct SlopeOf {
  Of f;
  double p;

  double operator()(const DoubleDouble& x, const DoubleDouble& y) const {
    const double distance = (x - y).hi;
    if (f == Of::sqrt) return 1 / (std::sqrt(x.hi) + std::sqrt(y.hi));
    const double of_log = distance > 0 ? std::log1p(distance / y.hi) / distance : 1 / y.hi;
    if (f == Of::log) return of_log;
    const double t = p * of_log * distance;  // p log(x / y)
    const double of_exp = t != 0 ? -std::expm1(-std::fabs(t)) / std::fabs(t) : 1;
    return p * of_log * std::pow(t > 0 ? x.hi : y.hi, p) * of_exp;
  }
};

/// f(256 S) goes by that power of 256.
double homogeneity(const SlopeOf& slope) {
  return slope.f == Of::pow ? slope.p : slope.f == Of::sqrt ? 0.5 : 0;
}

/// f'(S)[E] = V (F o V^T E V) V^T, where F has the slopes between eigenvalues (Daleckii and Krein 1965).
Sym3<double> derivative_by_slopes(const SlopeOf& slope, const Sym3<double>& s,
                                  const Sym3<double>& direction) {
  if (!is_usable(s) || !is_finite(direction)) return nan_matrix<double>();
  if (has_huge_eigenvalues(direction)) {
    return times(derivative_by_slopes(slope, s, times(direction, 0x1p-8)), 0x1p8);
  }
  if (has_huge_eigenvalues(s)) {
    return times(derivative_by_slopes(slope, times(s, 0x1p-8), direction),
                 std::exp2(8 * (homogeneity(slope) - 1)));
  }
  const auto e = eigen_of<DoubleDouble>(s, comfortable_scale(s));
  if (!(smallest(e) > 0)) return nan_matrix<double>();
  const auto between = [&](int k, int l) {
    const DoubleDouble &x = e.values[k], &y = e.values[l];
    return x.hi >= y.hi ? slope(x, y) : slope(y, x);
  };
  const Axes v = axes_of(e);
  Sym3<double> g = in_axes(v, direction);
  g.xx *= between(0, 0), g.xy *= between(0, 1), g.xz *= between(0, 2);
  g.yy *= between(1, 1), g.yz *= between(1, 2), g.zz *= between(2, 2);
  return in_axes(transposed(v), g);
}

}  // namespace

#define VIETE_FOR(T)                                                           \
  void log_by_jacobi(const T* in, T* out) {                                    \
    to_six(log_in_double(from_six(in)), out);                                  \
  }                                                                            \
  void sqrt_by_jacobi(const T* in, T* out) {                                   \
    to_six(sqrt_in_double<T>(from_six(in)), out);                              \
  }                                                                            \
  void inv_sqrt_by_jacobi(const T* in, T* out) {                               \
    to_six(inv_sqrt_in_double(from_six(in)), out);                             \
  }                                                                            \
  void spectral_derivative_by_jacobi(Of f, double p, const T* in, T* out) {    \
    to_six(derivative_by_slopes({f, p}, from_six(in), from_six(in + 6)), out); \
  }                                                                            \
  void eigenvalues_by_jacobi(const T* in, T* out) {                            \
    const auto values = eigenvalues_in_double(from_six(in));                   \
    for (int k = 0; k < 3; ++k) out[k] = T(values[k]);                         \
  }
VIETE_FOR(float)
VIETE_FOR(double)
#undef VIETE_FOR

}  // namespace viete::sym3
