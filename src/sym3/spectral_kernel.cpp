// log, square roots, powers and eigenvalues of batches, compiled once per instruction set.
#include "sym3/highway_targets.h"
#define HWY_TARGET_INCLUDE "sym3/spectral_kernel.cpp"
#include <hwy/foreach_target.h>

#include "sym3/by_jacobi.h"
#include "sym3/map-inl.h"
#include "sym3/spectral-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

template <class V>
static HWY_INLINE Six<V> six(const V* s) {
  return {s[0], s[1], s[2], s[3], s[4], s[5]};
}

template <class V>
static HWY_INLINE void put_six(const Six<V>& m, V* out) {
  out[0] = m.xx, out[1] = m.xy, out[2] = m.xz, out[3] = m.yy, out[4] = m.yz, out[5] = m.zz;
}

/// F::lanes where the spectrum is ordinary, F::one for the others.
template <class F>
struct OfPositive {
  static constexpr int in = 6, out = 6, group = 1;

  template <int G, class D, class V>
  HWY_INLINE void run(D d, const V (&from)[G][in], V (&to)[G][out]) const {
    for (int g = 0; g < G; ++g) run_one(d, from[g], to[g]);
  }

  template <class D, class V>
  HWY_INLINE void run_one(D d, const V* in, V* out) const {
    const Six<V> s = six(in);
    const Spectrum<V> e = spectrum(d, s);
    const auto ok = is_ordinary(d, e);
    const Six<V> quick = F::lanes(d, s, e);
    if (HWY_LIKELY(hn::AllTrue(d, ok))) return put_six(quick, out);
    put_six(replace(d, hn::Not(ok), s, quick), out);
  }

private:
  template <class D, class V>
  static HWY_NOINLINE Six<V> replace(D d, const hn::Mask<D>& bad, const Six<V>& s, const Six<V>& quick) {
    using T = hn::TFromD<D>;
    return replace_lanes(d, bad, s, quick, [](const T* in, T* out) { F::one(in, out); });
  }
};

struct Sqrt {
  template <class D, class V>
  static HWY_INLINE Six<V> lanes(D d, const Six<V>&, const Spectrum<V>& e) {
    return sqrt_lanes(d, e);
  }
  template <class T>
  static void one(const T* in, T* out) {
    sqrt_by_jacobi(in, out);
  }
};

struct InvSqrt {
  template <class D, class V>
  static HWY_INLINE Six<V> lanes(D d, const Six<V>&, const Spectrum<V>& e) {
    return inv_sqrt_lanes(d, e);
  }
  template <class T>
  static void one(const T* in, T* out) {
    inv_sqrt_by_jacobi(in, out);
  }
};

struct Log {
  template <class D, class V>
  static HWY_INLINE Six<V> lanes(D d, const Six<V>& s, const Spectrum<V>& e) {
    return log_lanes(d, s, e);
  }
  template <class T>
  static void one(const T* in, T* out) {
    log_by_jacobi(in, out);
  }
};

struct Pow {
  static constexpr int in = 6, out = 6, group = 1;
  double exponent;

  template <int G, class D, class V>
  HWY_INLINE void run(D d, const V (&from)[G][in], V (&to)[G][out]) const {
    for (int g = 0; g < G; ++g) run_one(d, from[g], to[g]);
  }

  template <class D, class V>
  HWY_INLINE void run_one(D d, const V* s, V* out) const {
    V log[6];
    OfPositive<Log>().run_one(d, s, log);
    put_six(exp_lanes(d, times(six(log), hn::Set(d, hn::TFromD<D>(exponent)))), out);
  }
};

struct Eigenvalues {
  static constexpr int in = 6, out = 3, group = 1;

  template <int G, class D, class V>
  HWY_INLINE void run(D d, const V (&from)[G][in], V (&to)[G][out]) const {
    for (int g = 0; g < G; ++g) run_one(d, from[g], to[g]);
  }

  template <class D, class V>
  HWY_INLINE void run_one(D d, const V* in, V* out) const {
    using T = hn::TFromD<D>;
    const Six<V> s = six(in);
    const Three<V> quick = eigenvalues_lanes(d, spectrum(d, s));
    out[0] = quick.x, out[1] = quick.y, out[2] = quick.z;
    const V size = largest_entry(s);
    const auto finite = is_finite(d, s);
    const auto ok = hn::And(finite, hn::And(hn::Ge(size, hn::Set(d, T(sizeof(T) == 8 ? 1e-290 : 1e-30))),
                                            hn::Le(size, hn::Set(d, T(sizeof(T) == 8 ? 1e300 : 1e37)))));
    if (HWY_UNLIKELY(!hn::AllTrue(d, ok))) replace(d, hn::Not(ok), s, out);
  }

private:
  template <class D, class V>
  static HWY_NOINLINE void replace(D d, const hn::Mask<D>& bad, const Six<V>& s, V* out) {
    using T = hn::TFromD<D>;
    const Six<V> quick = {out[0], out[1], out[2], out[0], out[1], out[2]};
    const Six<V> all = replace_lanes(d, bad, s, quick, [](const T* in, T* to) {
      eigenvalues_by_jacobi(in, to);
      to[3] = to[4] = to[5] = 0;
    });
    out[0] = all.xx, out[1] = all.xy, out[2] = all.xz;
  }
};

template <class T>
static void pow_many(const View<const T, 6>& in, const View<T, 6>& out, const Range& range, double exponent) {
  map_many(Pow{exponent}, in, out, range);
}

#define VIETE_DEFINE(name, F, N, M)                                                               \
  extern const Function<double, N, M> name##_double;                                              \
  extern const Function<float, N, M> name##_float;                                                \
  const Function<double, N, M> name##_double = {Mapped<F, double>::one, Mapped<F, double>::many}; \
  const Function<float, N, M> name##_float = {Mapped<F, float>::one, Mapped<F, float>::many};
VIETE_DEFINE(log, OfPositive<Log>, 6, 6)
VIETE_DEFINE(sqrt, OfPositive<Sqrt>, 6, 6)
VIETE_DEFINE(inv_sqrt, OfPositive<InvSqrt>, 6, 6)
VIETE_DEFINE(eigenvalues, Eigenvalues, 6, 3)
#undef VIETE_DEFINE

extern const PowFunctions pow_functions;
const PowFunctions pow_functions = {pow_many<double>, pow_many<float>};

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
