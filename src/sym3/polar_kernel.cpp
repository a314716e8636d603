// Polar decompositions of batches, compiled once for each instruction set.
#include "sym3/highway_targets.h"
#define HWY_TARGET_INCLUDE "sym3/polar_kernel.cpp"
#include <hwy/foreach_target.h>

#include "sym3/batch-inl.h"
#include "sym3/fallback.h"
#include "sym3/polar-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

struct RotationOf {
  static constexpr int in = 9, out = 9, group = 2;
  static constexpr bool memory_bound = false;

  template <int G, class D, class V>
  HWY_INLINE bool quick(D d, const V (&m)[G][in], V (&r)[G][out]) const {
    Nine<V> from[G];
    Rotations<D> answer[G];
#pragma GCC unroll 4
    for (int g = 0; g < G; ++g) from[g] = nine(m[g]);
    polar_quick<G>(d, from, answer);
    bool done = true;
#pragma GCC unroll 4
    for (int g = 0; g < G; ++g) {
      put_nine(answer[g].r, r[g]);
      done = done && hn::AllTrue(d, answer[g].ok);
    }
    return done;
  }
  template <class D, class V>
  HWY_INLINE void general(D d, const V (&m)[in], V (&r)[out]) const {
    const Nine<V> from[1] = {nine(m)};
    Rotations<D> answer[1];
    polar_quick<1>(d, from, answer);
    put_nine(answer[0].r, r);
    replace_lanes(d, hn::Not(answer[0].ok), m, r,
                  [](const auto* in, auto* out) { polar_by_jacobi(in, out); });
  }
};

struct RotationAndStretch {
  static constexpr int in = 9, out = 15, group = 2;
  static constexpr bool memory_bound = false;

  template <int G, class D, class V>
  HWY_INLINE bool quick(D d, const V (&m)[G][in], V (&both)[G][out]) const {
    V r[G][9];
    const bool done = RotationOf().quick<G>(d, m, r);
#pragma GCC unroll 4
    for (int g = 0; g < G; ++g) put_both(d, r[g], m[g], both[g]);
    return done;
  }
  template <class D, class V>
  HWY_INLINE void general(D d, const V (&m)[in], V (&both)[out]) const {
    V r[9];
    RotationOf().general(d, m, r);
    put_in_range(d, r, m, both);
  }

private:
  /// Like put_both(), but scales large matrices down, because sums of three entries could overflow.
  template <class D, class V>
  static HWY_INLINE void put_in_range(D d, const V (&r)[9], const V (&m)[9], V (&both)[out]) {
    using T = hn::TFromD<D>;
    const V one = hn::Set(d, T(1));
    V size = hn::Zero(d), scaled[9];
    for (const V& x : m) size = hn::Max(size, hn::Abs(x));
    const auto large = hn::Gt(size, hn::Set(d, T(sizeof(T) == 8 ? 1e307 : 1e37)));
    const V down = hn::IfThenElse(large, hn::Set(d, T(0.0625)), one),
            up = hn::IfThenElse(large, hn::Set(d, T(16)), one);
    for (int k = 0; k < in; ++k) scaled[k] = hn::Mul(m[k], down);
    put_both(d, r, scaled, both);
    for (int k = 9; k < out; ++k) both[k] = hn::Mul(both[k], up);
  }

  template <class D, class V>
  static HWY_INLINE void put_both(D d, const V (&r)[9], const V (&m)[9], V (&both)[out]) {
    V u[6];
    put_six(stretch(d, nine(r), nine(m)), u);
#pragma GCC unroll 16
    for (int k = 0; k < out; ++k) both[k] = k < 9 ? r[k] : u[k - 9];
  }
};

template <class T>
static void polar_one(const T* in, T* out) {
  map_one(RotationAndStretch{}, in, out);
}

template <class T>
static void polar_many(const View<const T, 9>& in, const View<T, 9>& rotations, const View<T, 6>& stretches,
                       const Range& range) {
  const hn::ScalableTag<T> d;
  constexpr std::size_t stride = Tile<T>::stride;
  const auto put = [&](const T* numbers, std::size_t i, std::size_t count) HWY_ATTR {
    scatter(d, numbers, stride, count, rotations, i);
    scatter(d, numbers + 9 * stride, stride, count, stretches, i);
  };
  map_tiles(d, RotationAndStretch{}, in, range.begin, range.end, put);
}

VIETE_DEFINE_FUNCTION(rotation_of, RotationOf)

extern const PolarFunction<double> polar_double;
extern const PolarFunction<float> polar_float;
const PolarFunction<double> polar_double = {polar_one<double>, polar_many<double>};
const PolarFunction<float> polar_float = {polar_one<float>, polar_many<float>};

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
