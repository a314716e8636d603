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
  static constexpr int in = 9, out = 9;

  template <class D, class V>
  HWY_INLINE void run(D d, const V* m, V* r) const {
    const auto quick = polar_quick(d, Nine<V>{m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]});
    r[0] = quick.r.xx, r[1] = quick.r.xy, r[2] = quick.r.xz;
    r[3] = quick.r.yx, r[4] = quick.r.yy, r[5] = quick.r.yz;
    r[6] = quick.r.zx, r[7] = quick.r.zy, r[8] = quick.r.zz;
    if (HWY_UNLIKELY(!hn::AllTrue(d, quick.ok))) replace(d, quick.ok, m, r);
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
