// The data that frame kernels work on. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

#include "deform/frame_vertex.h"
#include "deform/leaves.h"
#include "deform/rows.h"

namespace viete::deform {

/// Vertices per 64-byte cache line: the block size of weights, offsets and sums.
template <class T>
inline constexpr std::size_t tile_lanes = 64 / sizeof(T);
inline constexpr std::size_t lanes = tile_lanes<float>;  ///< block size of the stored weights

/// Consecutive tiles whose vertices share a table. Everything is aligned to 64 bytes.
template <class T>
struct TileRun {
  std::size_t tiles = 0;       ///< even
  std::size_t rows = 0;        ///< rows of weights
  const T* weights = nullptr;  ///< [tile][row][lane]
  const T* table = nullptr;    ///< [row][column]
  const T* base = nullptr;     ///< sums to start from, [tile][sum][lane]; null: zero
  const T* mean = nullptr;     ///< [RowShape::with_mean], what `place` adds to the sums; null: zero
  const T* shares = nullptr;   ///< [tile][lane], for `place`: see Shares; null: all 1
  const std::uint32_t* listed = nullptr;  ///< the table's row for each row of weights; null: in order
  const T* rest_moments = nullptr;        ///< forms with moments only: [tile][rest_moment_lines][lane]
};
/// n, s, dual, scale of RestMoment, lengths in l.
inline constexpr std::size_t rest_moment_lines = 10;

/// The positions of one leaf, each as x y z x: its slots, then its ghosts, which must have been copied from
/// other leaves' slots.
struct RingRun {
  float* positions;                 ///< all positions of the model
  std::size_t first, slots, count;  ///< first position of the leaf; slots; slots plus ghosts
  std::size_t vertices;             ///< number of slots without padding
  bool moved;                       ///< true if slots moved since the last normals
  const std::uint32_t* ghosts;
  std::size_t ghosts_left;  ///< ghosts of this leaf and of all later ones: the limit of prefetching
  const std::uint32_t* order;
  const std::uint16_t *neighbours, *lengths;  ///< as in Rings, for this leaf
  float unit;
};

/// From weights to sums or positions, for rows of one form.
struct TileKernel {
  std::size_t sums;  ///< sums per vertex: the columns of a row, except for moments
  /// sums [tile][sum][lane].
  void (*blend)(const TileRun<float>& run, float* sums);
  /// rest, offsets [tile][3][lane]: x and o of RowForm; out [slot] as x y z x.
  void (*place)(const TileRun<float>& run, const float* rest, const float* offsets, float* out);
};

}  // namespace viete::deform
