// Vector code of the fused engine: from weights and rows to positions and normals. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

#include "deform/frame_jobs.h"
#include "sym3/kernel.h"

namespace viete::deform {

/// The functions for one instruction set. The results are equal bit for bit for all vector widths, but differ
/// between instruction sets with and without fused multiply-add.
struct FrameKernel {
  TileKernel forms[pose::row_forms];  ///< one per RowForm
  /// Copies the ghosts. Then writes position * run.unit and the normal of each slot to vertices[order[slot]].
  /// A normal has length 1; it is (0, 0, 1) if the triangles have no area. If no slot or ghost changed, does
  /// nothing. Several threads may process different leaves at once.
  void (*ring_vertices)(const RingRun& run, pose::FrameVertex* vertices);
  /// Writes the normal of a vertex of high valence (see Rings), which ring_vertices() does not compute.
  void (*ring_high_valence)(const float* positions, const std::uint32_t* neighbours, std::size_t length,
                            std::uint32_t position, pose::FrameVertex& vertex);
};

const FrameKernel& frame_kernel(const sym3::Kernel& kernel);

}  // namespace viete::deform
