#include "sparse/sparse_kernel.h"

#include "sym3/highway_targets.h"

#define HWY_TARGET_INCLUDE "sparse/sparse_kernel.cpp"
#include <hwy/foreach_target.h>

#include "sparse/front_kernel-inl.h"
#include "sparse/solve_kernel-inl.h"

HWY_BEFORE_NAMESPACE();

namespace viete::sparse::HWY_NAMESPACE {

// Vector code of sparse factors, compiled once per instruction set.

static const SparseKernel sparse = {solve_forward<solved_columns>,
                                    solve_backward<solved_columns>,
                                    solve_forward<4>,
                                    solve_backward<4>,
                                    eliminate,
                                    subtract_product};

}  // namespace viete::sparse::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace viete::sparse {

const SparseKernel& sparse_kernel(const sym3::Kernel& kernel) {
  VIETE_RETURN_COMPILED(sparse, kernel.highway_target);
}

}  // namespace viete::sparse

#endif
