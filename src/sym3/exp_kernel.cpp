// exp of batches, compiled once for each instruction set.
#include "sym3/highway_targets.h"
#define HWY_TARGET_INCLUDE "sym3/exp_kernel.cpp"
#include <hwy/foreach_target.h>

#include "sym3/batch-inl.h"
#include "sym3/exp-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

struct Exp {
  static constexpr int in = 6, out = 6, group = 2;
  static constexpr bool memory_bound = true;

  template <int G, class D, class V>
  HWY_INLINE bool quick(D d, const V (&s)[G][in], V (&e)[G][out]) const {
    if constexpr (G == 1) {
      Six<V> answer;
      if (!exp_quick(d, six(s[0]), answer)) return false;
      put_six(answer, e[0]);
    } else {
      Six<Two<V>> answer;
      if (!exp_quick(d, together(six(s[0]), six(s[1])), answer)) return false;
      put_six(first(answer), e[0]);
      put_six(second(answer), e[1]);
    }
    return true;
  }
  template <class D, class V>
  HWY_INLINE void general(D d, const V (&s)[in], V (&e)[out]) const {
    put_six(exp_general(d, six(s)), e);
  }
};

VIETE_DEFINE_FUNCTION(exp, Exp)

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
