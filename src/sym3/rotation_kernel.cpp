// exp of batches of rotation vectors, compiled once per instruction set.
#include "sym3/highway_targets.h"
#define HWY_TARGET_INCLUDE "sym3/rotation_kernel.cpp"
#include <hwy/foreach_target.h>

#include "sym3/map-inl.h"
#include "sym3/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

struct ExpRotation {
  static constexpr int in = 3, out = 9;

  template <class D, class V>
  HWY_INLINE void run(D d, const V* w, V* r) const {
    const Nine<V> m = exp_rotation_lanes(d, Three<V>{w[0], w[1], w[2]});
    r[0] = m.xx, r[1] = m.xy, r[2] = m.xz;
    r[3] = m.yx, r[4] = m.yy, r[5] = m.yz;
    r[6] = m.zx, r[7] = m.zy, r[8] = m.zz;
  }
};

extern const Function<double, 3, 9> exp_rotation_double;
extern const Function<float, 3, 9> exp_rotation_float;
const Function<double, 3, 9> exp_rotation_double = {Mapped<ExpRotation, double>::one,
                                                    Mapped<ExpRotation, double>::many};
const Function<float, 3, 9> exp_rotation_float = {Mapped<ExpRotation, float>::one,
                                                  Mapped<ExpRotation, float>::many};

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
