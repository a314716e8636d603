// Nearest rotations of batches, compiled once per instruction set.
#include "sym3/highway_targets.h"
#define HWY_TARGET_INCLUDE "sym3/polar_kernel.cpp"
#include <hwy/foreach_target.h>

#include "sym3/map-inl.h"
#include "sym3/polar-inl.h"
#include "sym3/polar_by_jacobi.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

struct Polar {
  static constexpr int in = 9, out = 9, group = 2;

  template <int G, class D, class V>
  HWY_INLINE void run(D d, const V (&m)[G][in], V (&r)[G][out]) const {
    Nine<V> from[G];
    Rotations<D> quick[G];
#pragma GCC unroll 4
    for (int g = 0; g < G; ++g) {
      from[g] = {m[g][0], m[g][1], m[g][2], m[g][3], m[g][4], m[g][5], m[g][6], m[g][7], m[g][8]};
    }
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

extern const Function<double, 9, 9> polar_double;
extern const Function<float, 9, 9> polar_float;
const Function<double, 9, 9> polar_double = {Mapped<Polar, double>::one, Mapped<Polar, double>::many};
const Function<float, 9, 9> polar_float = {Mapped<Polar, float>::one, Mapped<Polar, float>::many};

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
