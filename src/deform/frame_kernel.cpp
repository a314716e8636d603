// The fused frame, compiled once per instruction set.
#include "deform/frame_kernel.h"

#include "deform/sparse/kernel_choice.h"
#include "sym3/highway_targets.h"
#define HWY_TARGET_INCLUDE "deform/frame_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/cache_control.h>

#include "deform/frame_kernel-inl.h"
#include "deform/moments_kernel-inl.h"
#include "deform/ring_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::deform::HWY_NAMESPACE {

static const FrameKernel frame = {
    {tile_kernel<ByLogs>(), tile_kernel<ByMaps>(), tile_kernel<ByPositions>(), tile_kernel<ByStretches>(),
     tile_kernel<ByQuaternions>(), tile_kernel<ByMatrixLogs>(), tile_kernel<ByScrews>(),
     tile_kernel<ByAffineLogs>(), moment_kernel<AffineFit>(), moment_kernel<SimilarFit>(),
     moment_kernel<RigidFit>()},
    ring_vertices,
    ring_high_valence};

}  // namespace viete::deform::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace viete::deform {

const FrameKernel& frame_kernel(const sym3::Kernel& kernel) {
  VIETE_RETURN_COMPILED(frame, kernel.highway_target);
}

}  // namespace viete::deform
#endif
