// exp of many rotation vectors and log of many rotations, compiled once for each instruction set.
#include "sym3/highway_targets.h"
#define HWY_TARGET_INCLUDE "sym3/rotation_kernel.cpp"
#include <hwy/foreach_target.h>

#include "sym3/batch-inl.h"
#include "sym3/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

struct ExpRotation {
  static constexpr int in = 3, out = 9, group = 1;
  static constexpr bool memory_bound = false;

  template <int G, class D, class V>
  HWY_INLINE bool quick(D d, const V (&w)[G][in], V (&r)[G][out]) const {
    put_nine(exp_rotation_lanes(d, Three<V>{w[0][0], w[0][1], w[0][2]}), r[0]);
    return true;
  }
};

struct LogRotation {
  static constexpr int in = 9, out = 3, group = 1;
  static constexpr bool memory_bound = false;

  template <int G, class D, class V>
  HWY_INLINE bool quick(D d, const V (&r)[G][in], V (&w)[G][out]) const {
    put_three(log_rotation_lanes(d, nine(r[0])), w[0]);
    return true;
  }
};

VIETE_DEFINE_FUNCTION(exp_rotation, ExpRotation)
VIETE_DEFINE_FUNCTION(log_rotation, LogRotation)

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
