// The fused frame in vector code, from weights and logs to positions. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

#include "deform/frame_vertex.h"
#include "deform/leaves.h"
#include "deform/rows.h"
#include "sym3/kernel.h"

namespace viete::deform {

/// One 64-byte line of vertices: what weights, offsets and sums are stored by.
template <class T>
inline constexpr std::size_t tile_lanes = 64 / sizeof(T);
inline constexpr std::size_t lanes = tile_lanes<float>;  ///< of weights as they are kept

/// Consecutive tiles whose vertices share a table. Everything is aligned to 64 bytes.
template <class T>
struct TileRun {
  std::size_t tiles = 0;       ///< even
  std::size_t rows = 0;        ///< of weights
  const T* weights = nullptr;  ///< [tile][row][lane]
  const T* table = nullptr;    ///< [row][column]
  const T* base = nullptr;     ///< sums to start from, [tile][sum][lane]; null: zero
  const T* mean = nullptr;     ///< [RowShape::with_mean], what `place` adds to the sums; null: zero
  const T* shares = nullptr;  ///< [tile][lane], what `place` makes of sums and offsets: see Shares; null: all
  const std::uint32_t* listed = nullptr;  ///< the table's row for each row of weights; null: in order
  const T* rest_moments = nullptr;  ///< of forms with moments: [tile][rest_moment_lines][lane], else not read
};
/// n, s, dual, scale of RestMoment, lengths in l.
inline constexpr std::size_t rest_moment_lines = 10;

/// The positions of one leaf, x y z x each: its slots, then its ghosts, which are copied from other leaves'
/// slots first.
struct RingRun {
  float* positions;                 ///< of the whole model
  std::size_t first, slots, count;  ///< the leaf's first position; its slots; slots and ghosts
  std::size_t vertices;             ///< slots that are no padding
  bool moved;                       ///< its slots, since its normals were computed
  const std::uint32_t* ghosts;
  std::size_t ghosts_left;  ///< ghosts of this leaf and all behind it: how far prefetching may look
  const std::uint32_t* order;
  const std::uint16_t *neighbours, *lengths;  ///< as in Rings, of this leaf
  float unit;
};

/// From weights to sums or positions, of rows of one form.
struct TileKernel {
  std::size_t sums;  ///< how many a vertex has: columns of the rows, but for moments
  /// sums [tile][sum][lane].
  void (*blend)(const TileRun<float>& run, float* sums);
  /// rest, offsets [tile][3][lane]: x and o of RowForm; out [slot] as x y z x.
  void (*place)(const TileRun<float>& run, const float* rest, const float* offsets, float* out);
};

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
