// exp of batches, compiled once per instruction set.
#include "sym3/highway_targets.h"
#define HWY_TARGET_INCLUDE "sym3/exp_kernel.cpp"
#include <hwy/foreach_target.h>

#include "sym3/exp-inl.h"
#include "sym3/sym_function-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

struct Exp {
  template <class D, class V>
  static HWY_INLINE bool quick(D d, const Six<V>& s, Six<V>& e) {
    return exp_quick(d, s, e);
  }
  template <class D, class V>
  static HWY_INLINE Six<V> general(D d, const Six<V>& s) {
    return exp_general(d, s);
  }
};

extern const Function<double, 6, 6> exp_double;
extern const Function<float, 6, 6> exp_float;
const Function<double, 6, 6> exp_double = {Batched<Exp, double>::one, Batched<Exp, double>::many};
const Function<float, 6, 6> exp_float = {Batched<Exp, float>::one, Batched<Exp, float>::many};

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
