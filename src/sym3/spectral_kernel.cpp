// log, square roots, powers and eigenvalues of batches, compiled once for each instruction set.
#include "sym3/highway_targets.h"
#define HWY_TARGET_INCLUDE "sym3/spectral_kernel.cpp"
#include <hwy/foreach_target.h>

#include "sym3/batch-inl.h"
#include "sym3/fallback.h"
#include "sym3/spectral-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

/// A function of positive definite matrices, F::of(). See WithFallback.
template <class F>
struct OfPositive : F {
  static constexpr int in = 6, out = 6;

  template <class D, class V>
  static HWY_INLINE hn::Mask<D> lanes(D d, const V (&in)[6], V (&out)[6]) {
    const Six<V> s = six(in);
    const Spectrum<V> e = spectrum(d, s);
    put_six(F::of(d, s, e), out);
    return is_ordinary(d, e);
  }
};

struct Sqrt {
  template <class D, class V>
  static HWY_INLINE Six<V> of(D, const Six<V>&, const Spectrum<V>& e) {
    return sqrt_lanes(e);
  }
  static constexpr auto by_jacobi = [](const auto* in, auto* out) { sqrt_by_jacobi(in, out); };
};

struct InvSqrt {
  template <class D, class V>
  static HWY_INLINE Six<V> of(D d, const Six<V>&, const Spectrum<V>& e) {
    return inv_sqrt_lanes(d, e);
  }
  static constexpr auto by_jacobi = [](const auto* in, auto* out) { inv_sqrt_by_jacobi(in, out); };
};

struct Log {
  template <class D, class V>
  static HWY_INLINE Six<V> of(D d, const Six<V>& s, const Spectrum<V>& e) {
    return log_lanes(d, s, e);
  }
  static constexpr auto by_jacobi = [](const auto* in, auto* out) { log_by_jacobi(in, out); };
};

struct Pow {
  static constexpr int in = 6, out = 6, group = 1;
  static constexpr bool memory_bound = false;
  double exponent;

  template <int G, class D, class V>
  HWY_INLINE bool quick(D d, const V (&s)[G][in], V (&power)[G][out]) const {
    V log[1][6];
    const bool done = WithFallback<OfPositive<Log>>().quick<1>(d, s, log);
    put_six(exp_lanes(d, times(six(log[0]), hn::Set(d, hn::TFromD<D>(exponent)))), power[0]);
    return done;
  }
  template <class D, class V>
  HWY_INLINE void general(D d, const V (&s)[in], V (&power)[out]) const {
    V log[6];
    WithFallback<OfPositive<Log>>().general(d, s, log);
    put_six(exp_lanes(d, times(six(log), hn::Set(d, hn::TFromD<D>(exponent)))), power);
  }
};

struct Eigenvalues {
  static constexpr int in = 6, out = 3;

  template <class D, class V>
  static HWY_INLINE hn::Mask<D> lanes(D d, const V (&in)[6], V (&out)[3]) {
    const Six<V> s = six(in);
    put_three(eigenvalues_lanes(d, spectrum(d, s)), out);
    return has_ordinary_size(d, s);
  }
  static constexpr auto by_jacobi = [](const auto* in, auto* out) { eigenvalues_by_jacobi(in, out); };
};

VIETE_DEFINE_FUNCTION(log, WithFallback<OfPositive<Log>>)
VIETE_DEFINE_FUNCTION(sqrt, WithFallback<OfPositive<Sqrt>>)
VIETE_DEFINE_FUNCTION(inv_sqrt, WithFallback<OfPositive<InvSqrt>>)
VIETE_DEFINE_FUNCTION(pow, Pow, double)
VIETE_DEFINE_FUNCTION(eigenvalues, WithFallback<Eigenvalues>)

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
