// The fused frame in vector code: from weights and logs to positions, without storing the sums. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

#include "deform/frame_jobs.h"
#include "deform/frame_vertex.h"
#include "deform/leaves.h"
#include "deform/rings.h"
#include "deform/rows.h"
#include "sym3/kernel.h"

namespace viete::deform {

/// One compilation of the frame. Each lane is computed alone and in the same order whatever the width of the
/// machine's vectors: the same bits from all kernels with fused multiply-add, and from all without.
struct FrameKernel {
  TileKernel forms[row_forms];  ///< by RowForm
  /// To vertices[order[slot]]: position times unit, and the unit normal by its one-ring, (0, 0, 1)
  /// where there is no area; nothing where neither slots nor ghosts changed by a bit. Leaves write to
  /// different places and vertices.
  void (*ring_vertices)(const RingRun& run, FrameVertex* vertices);
  /// The normal of a vertex of high valence (see Rings), which ring_vertices leaves without one.
  void (*ring_high_valence)(const float* positions, const std::uint32_t* neighbours, std::size_t length,
                            std::uint32_t position, FrameVertex& vertex);
};

/// That of the same instruction set.
const FrameKernel& frame_kernel(const sym3::Kernel& kernel);

}  // namespace viete::deform
