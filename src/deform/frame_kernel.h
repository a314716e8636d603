// The fused frame in vector code: from weights and logs to positions, without storing the sums. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

#include "deform/leaves.h"
#include "deform/rings.h"
#include "sym3/kernel.h"

namespace viete::deform {

inline constexpr std::size_t log_size =
    12;  ///< six of the stretch, three of the rotation, three of the centre
inline constexpr std::size_t centre_column = 9;  ///< where those of the centre begin
inline constexpr std::size_t position_size = 3;  ///< mean value coordinates blend positions alone

/// One vertex of a frame, as a graphics card takes it.
struct alignas(32) FrameVertex {
  float position[3];  ///< relative to the frame's origin
  float unused0;
  float normal[3];  ///< unit length; (0, 0, 1) where there is no area
  float unused1;
};

/// One 64-byte line of vertices: what weights, offsets and sums are stored by.
template <class T>
inline constexpr std::size_t tile_lanes = 64 / sizeof(T);
inline constexpr std::size_t lanes = tile_lanes<float>;  ///< of weights as they are kept

/// Consecutive tiles whose vertices share a table. Everything is aligned to 64 bytes.
template <class T>
struct TileRun {
  std::size_t tiles = 0;                  ///< even
  std::size_t rows = 0;                   ///< of weights
  const T* weights = nullptr;             ///< [tile][row][lane]
  const T* table = nullptr;               ///< [row][column], 12 or 3 columns
  const T* base = nullptr;                ///< sums to start from, [tile][column][lane]; null: zero
  const T* mean = nullptr;                ///< [9], what `deform` adds to the blended logs; null: zero
  const std::uint32_t* listed = nullptr;  ///< the table's row for each row of weights; null: in order
};

/// One leaf: its places, x y z x each, slots first; the halo is filled from other leaves' slots.
struct RingRun {
  float* positions;                  ///< of the whole model
  std::size_t first, slots, places;  ///< of the leaf
  std::size_t vertices;              ///< slots that are no filling
  bool moved;                        ///< its slots, since its normals were computed
  const std::uint32_t* halo;
  std::size_t halo_left;  ///< numbers in halo, those of the leaves behind this one too
  const std::uint32_t* order;
  const std::uint16_t *walk, *lengths;  ///< as in Rings, of this leaf
  float unit;
};

/// From weights to sums or positions.
template <class T>
struct TileKernel {
  /// sums [tile][column][lane] of 12 columns.
  void (*blend)(const TileRun<T>& run, T* sums);
  /// exp(Y) exp(X) offset + center of the 12 blended columns; offsets [tile][3][lane]; out [slot] as x y z x.
  void (*deform)(const TileRun<T>& run, const T* offsets, T* out);
  /// The 3 blended columns + offset.
  void (*move)(const TileRun<T>& run, const T* offsets, T* out);
};

/// One compilation of the frame. Each lane is computed alone and in the same order whatever the width of the
/// machine's vectors: the same bits from all kernels with fused multiply-add, and from all without.
struct FrameKernel {
  TileKernel<float> in_float;
  TileKernel<double> in_double;
  /// To vertices[order[slot]]: position times unit, and the unit normal by the walk around it, (0, 0, 1)
  /// where there is no area; nothing where neither slots nor halo changed by a bit. Leaves write to different
  /// places and vertices.
  void (*ring_vertices)(const RingRun& run, FrameVertex* vertices);
  /// The normal of a hub (see Rings), which ring_vertices leaves out.
  void (*ring_hub)(const float* positions, const std::uint32_t* walk, std::size_t length, std::uint32_t place,
                   FrameVertex& vertex);
};

/// That of the same instruction set.
const FrameKernel& frame_kernel(const sym3::Kernel& kernel);

}  // namespace viete::deform
