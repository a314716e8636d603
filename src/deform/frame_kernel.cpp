#include "deform/frame_kernel.h"

#include "sym3/highway_targets.h"

#define HWY_TARGET_INCLUDE "deform/frame_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/cache_control.h>

#include "deform/frame_kernel-inl.h"
#include "deform/moments_kernel-inl.h"
#include "deform/ring_kernel-inl.h"

HWY_BEFORE_NAMESPACE();

namespace viete::deform::HWY_NAMESPACE {

static constexpr TileKernel kernel_of(pose::RowForm form) {
  switch (form) {
    case pose::RowForm::logs: return tile_kernel<ByLogs>();
    case pose::RowForm::maps: return tile_kernel<ByMaps>();
    case pose::RowForm::positions: return tile_kernel<ByPositions>();
    case pose::RowForm::affine_moments: return moment_kernel<AffineFit>();
    case pose::RowForm::similar_moments: return moment_kernel<SimilarFit>();
    case pose::RowForm::rigid_moments: return moment_kernel<RigidFit>();
  }
  return {};
}

static constexpr FrameKernel make_frame() {
  FrameKernel made{{}, ring_vertices, ring_high_valence};
  for (std::size_t form = 0; form < pose::row_forms; ++form)
    made.forms[form] = kernel_of(pose::RowForm(form));
  return made;
}
static constexpr FrameKernel frame = make_frame();
static_assert(pose::row_forms == std::size_t(pose::RowForm::rigid_moments) + 1);

}  // namespace viete::deform::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace viete::deform {

const FrameKernel& frame_kernel(const sym3::Kernel& kernel) {
  VIETE_RETURN_COMPILED(frame, kernel.highway_target);
}

}  // namespace viete::deform

#endif
