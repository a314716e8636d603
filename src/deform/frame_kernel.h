// The fused frame in vector code, from weights and logs to positions. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

#include "deform/frame_jobs.h"
#include "sym3/kernel.h"

namespace viete::deform {

/// One compilation of the frame. Each lane is computed independently, in an order that does not depend on the
/// vector width: all kernels with fused multiply-add give the same bits, and so do all without.
struct FrameKernel {
  TileKernel forms[row_forms];  ///< by RowForm
  /// Writes vertices[order[slot]]: position times unit, and the unit normal of the one-ring, (0, 0, 1)
  /// without area. Skips vertices whose slots and ghosts are bitwise unchanged. Leaves write to different
  /// places and vertices.
  void (*ring_vertices)(const RingRun& run, FrameVertex* vertices);
  /// The normal of a vertex of high valence (see Rings), which ring_vertices skips.
  void (*ring_high_valence)(const float* positions, const std::uint32_t* neighbours, std::size_t length,
                            std::uint32_t position, FrameVertex& vertex);
};

/// The kernel for the same instruction set.
const FrameKernel& frame_kernel(const sym3::Kernel& kernel);

}  // namespace viete::deform
