// A vectorised loop of another project, as documented in exp-inl.h, compiled for one instruction set.
#define HWY_COMPILE_ONLY_SCALAR
#include <viete/sym3/highway_targets.h>
#define HWY_TARGET_INCLUDE "with_highway.cpp"
#include <hwy/foreach_target.h>
#include <viete/sym3/exp-inl.h>
#include <viete/sym3/exp_derivative-inl.h>
#include <viete/sym3/rotation-inl.h>

HWY_BEFORE_NAMESPACE();
namespace stranger::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace lanes = viete::sym3::HWY_NAMESPACE;

/// With (x, y, z) = numbers: out[0] = exp([x y z; y x y; z y x]).xx, and out[1] = rotation(x, y, z).xx.
void both(const float* numbers, float* out) {
  const hn::CappedTag<float, 1> d;
  using V = hn::Vec<decltype(d)>;
  const V x = hn::LoadU(d, numbers), y = hn::LoadU(d, numbers + 1), z = hn::LoadU(d, numbers + 2);
  hn::StoreU(lanes::exp_lanes(d, lanes::Six<V>(x, y, z, x, y, x)).xx, d, out);
  hn::StoreU(lanes::exp_rotation_lanes(d, lanes::Three<V>{x, y, z}).xx, d, out + 1);
}

}  // namespace stranger::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
