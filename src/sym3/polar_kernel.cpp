// Nearest rotations of batches, and the stretches beside them, compiled once per instruction set.
#include "sym3/highway_targets.h"
#define HWY_TARGET_INCLUDE "sym3/polar_kernel.cpp"
#include <hwy/foreach_target.h>

#include "sym3/map-inl.h"
#include "sym3/polar-inl.h"
#include "sym3/polar_by_jacobi.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

template <class V>
static HWY_INLINE Nine<V> nine(const V* m) {
  return {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]};
}

struct RotationOf {
  static constexpr int in = 9, out = 9, group = 2;

  template <int G, class D, class V>
  HWY_INLINE void run(D d, const V (&m)[G][in], V (&r)[G][out]) const {
    Nine<V> from[G];
    Rotations<D> quick[G];
#pragma GCC unroll 4
    for (int g = 0; g < G; ++g) from[g] = nine(m[g]);
    polar_quick<G>(d, from, quick);
#pragma GCC unroll 4
    for (int g = 0; g < G; ++g) {
      const Nine<V>& q = quick[g].r;
      r[g][0] = q.xx, r[g][1] = q.xy, r[g][2] = q.xz;
      r[g][3] = q.yx, r[g][4] = q.yy, r[g][5] = q.yz;
      r[g][6] = q.zx, r[g][7] = q.zy, r[g][8] = q.zz;
      if (HWY_UNLIKELY(!hn::AllTrue(d, quick[g].ok))) replace(d, quick[g].ok, m[g], r[g]);
    }
  }

private:
  template <class D, class V>
  static HWY_NOINLINE void replace(D d, const hn::Mask<D>& ok, const V* m, V* r) {
    using T = hn::TFromD<D>;
    constexpr std::size_t lanes = hn::MaxLanes(D());
    HWY_ALIGN T from[9][lanes], to[9][lanes], good[lanes];
    for (int k = 0; k < 9; ++k) hn::Store(m[k], d, from[k]), hn::Store(r[k], d, to[k]);
    hn::Store(hn::IfThenElseZero(ok, hn::Set(d, T(1))), d, good);
    for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
      if (good[i] != 0) continue;
      T a[9], b[9];
      for (int k = 0; k < 9; ++k) a[k] = from[k][i];
      polar_by_jacobi(a, b);
      for (int k = 0; k < 9; ++k) to[k][i] = b[k];
    }
    for (int k = 0; k < 9; ++k) r[k] = hn::Load(d, to[k]);
  }
};

/// Nine numbers of the rotation, then six of the stretch.
struct RotationAndStretch {
  static constexpr int in = 9, out = 15, group = 2;

  template <int G, class D, class V>
  HWY_INLINE void run(D d, const V (&m)[G][in], V (&both)[G][out]) const {
    V r[G][9];
    RotationOf().run<G>(d, m, r);
#pragma GCC unroll 4
    for (int g = 0; g < G; ++g) {
      for (int k = 0; k < 9; ++k) both[g][k] = r[g][k];
      const Six<V> u = stretch(d, nine(r[g]), nine(m[g]));
      V* const six = both[g] + 9;
      six[0] = u.xx, six[1] = u.xy, six[2] = u.xz, six[3] = u.yy, six[4] = u.yz, six[5] = u.zz;
    }
  }
};

template <class T>
static void polar_one(const T* in, T* out) {
  map_one(RotationAndStretch{}, in, out);
}

/// All through tiles: their two outputs may lie in different layouts.
template <class T>
static void polar_many(const View<const T, 9>& in, const View<T, 9>& rotations, const View<T, 6>& stretches,
                       const Range& range) {
  const hn::ScalableTag<T> d;
  constexpr std::size_t tile = 64, stride = tile + 64 / sizeof(T);
  constexpr int G = RotationAndStretch::group;
  alignas(64) T from[9 * stride] = {}, to[15 * stride];
  const auto from_rows = rows_of<const T, 9>(from, stride);
  const auto to_rows = rows_of<T, 15>(to, stride);
  for (std::size_t i = range.begin; i < range.end; i += tile) {
    const std::size_t count = range.end - i < tile ? range.end - i : tile;
    gather(d, in, i, count, from, stride);
    for (std::size_t j = 0; j < count; j += G * hn::Lanes(d)) {
      map_registers<G>(d, RotationAndStretch{}, from_rows, to_rows, j);
    }
    scatter(d, to, stride, count, rotations, i);
    scatter(d, to + 9 * stride, stride, count, stretches, i);
  }
}

extern const Function<double, 9, 9> rotation_of_double;
extern const Function<float, 9, 9> rotation_of_float;
const Function<double, 9, 9> rotation_of_double = {Mapped<RotationOf, double>::one,
                                                   Mapped<RotationOf, double>::many};
const Function<float, 9, 9> rotation_of_float = {Mapped<RotationOf, float>::one,
                                                 Mapped<RotationOf, float>::many};

extern const PolarFunctions polar_functions;
const PolarFunctions polar_functions = {{polar_one<double>, polar_many<double>},
                                        {polar_one<float>, polar_many<float>}};

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
