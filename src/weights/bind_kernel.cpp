#include "weights/bind_kernel.h"

#include "sym3/highway_targets.h"

#define HWY_TARGET_INCLUDE "weights/bind_kernel.cpp"
#include <hwy/foreach_target.h>

#include "weights/bind_kernel-inl.h"
#include "weights/mean_value_kernel-inl.h"

HWY_BEFORE_NAMESPACE();

namespace viete::weights::HWY_NAMESPACE {

static constexpr BindKernel bind = {.inverse_distance = inverse_distance,
                                    .inverse_distance_rows = inverse_distance_rows,
                                    .cut_off = cut_off,
                                    .cut_off_rows = cut_off_rows,
                                    .mean_value = mean_value,
                                    .in_space = in_space,
                                    .to_rows = to_rows,
                                    .take_out = take_out,
                                    .solve = solve};

}  // namespace viete::weights::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace viete::weights {

const BindKernel& bind_kernel(const sym3::Kernel& kernel) {
  VIETE_RETURN_COMPILED(bind, kernel.highway_target);
}

}  // namespace viete::weights

#endif
