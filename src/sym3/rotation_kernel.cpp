// exp of batches of rotation vectors and log of batches of rotations, compiled once per instruction set.
#include "sym3/highway_targets.h"
#define HWY_TARGET_INCLUDE "sym3/rotation_kernel.cpp"
#include <hwy/foreach_target.h>

#include "sym3/map-inl.h"
#include "sym3/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

struct ExpRotation {
  static constexpr int in = 3, out = 9, group = 1;

  template <int G, class D, class V>
  HWY_INLINE void run(D d, const V (&w)[G][in], V (&r)[G][out]) const {
#pragma GCC unroll 4
    for (int g = 0; g < G; ++g) {
      const Nine<V> m = exp_rotation_lanes(d, Three<V>{w[g][0], w[g][1], w[g][2]});
      r[g][0] = m.xx, r[g][1] = m.xy, r[g][2] = m.xz;
      r[g][3] = m.yx, r[g][4] = m.yy, r[g][5] = m.yz;
      r[g][6] = m.zx, r[g][7] = m.zy, r[g][8] = m.zz;
    }
  }
};

struct LogRotation {
  static constexpr int in = 9, out = 3, group = 1;

  template <int G, class D, class V>
  HWY_INLINE void run(D d, const V (&r)[G][in], V (&w)[G][out]) const {
#pragma GCC unroll 4
    for (int g = 0; g < G; ++g) {
      const Three<V> v = log_rotation_lanes(
          d, Nine<V>{r[g][0], r[g][1], r[g][2], r[g][3], r[g][4], r[g][5], r[g][6], r[g][7], r[g][8]});
      w[g][0] = v.x, w[g][1] = v.y, w[g][2] = v.z;
    }
  }
};

extern const Function<double, 3, 9> exp_rotation_double;
extern const Function<float, 3, 9> exp_rotation_float;
const Function<double, 3, 9> exp_rotation_double = {Mapped<ExpRotation, double>::one,
                                                    Mapped<ExpRotation, double>::many};
const Function<float, 3, 9> exp_rotation_float = {Mapped<ExpRotation, float>::one,
                                                  Mapped<ExpRotation, float>::many};

extern const Function<double, 9, 3> log_rotation_double;
extern const Function<float, 9, 3> log_rotation_float;
const Function<double, 9, 3> log_rotation_double = {Mapped<LogRotation, double>::one,
                                                    Mapped<LogRotation, double>::many};
const Function<float, 9, 3> log_rotation_float = {Mapped<LogRotation, float>::one,
                                                  Mapped<LogRotation, float>::many};

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
