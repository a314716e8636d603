// Input and output of the frame kernels. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

#include "pose/rows.h"
#include "weights/leaves.h"

namespace viete::deform {

/// Consecutive tiles with one common table. All arrays are aligned to 64 bytes.
struct TileRun {
  std::size_t tiles = 0;           ///< must be even
  std::size_t rows = 0;            ///< rows of weights per tile
  const float* weights = nullptr;  ///< [tile][row][lane]
  const float* table = nullptr;    ///< [row][column]
  const float* base = nullptr;     ///< initial values of the sums, [tile][sum][lane]; null: 0
  const float* mean = nullptr;     ///< [RowShape::with_mean], added to the sums by TileKernel::apply; null: 0
  const float* shares = nullptr;   ///< [tile][lane], only for TileKernel::apply, see Shares; null: all 1
  const std::uint32_t* listed = nullptr;  ///< for each row of weights, its row of `table`; null: same index
  const float* rest_moments = nullptr;    ///< [tile][rest_moment_lines][lane], only for moment forms
};
/// Numbers per vertex: n (3), s (3), dual (3) and scale (1) of RestMoment. Lengths are in units of l.
inline constexpr std::size_t rest_moment_lines = 10;

/// The job of ring_vertices() for one leaf. Each position is stored as x y z x. The leaf's positions are its
/// slots, followed by its ghosts (copies of slots of other leaves).
struct RingRun {
  float* positions;                 ///< all positions of the model
  std::size_t first, slots, count;  ///< first: index of the leaf's first position; count: slots plus ghosts
  std::size_t vertices;             ///< the number of slots without padding
  bool moved;                       ///< true if slots moved since normals were last computed
  const std::uint32_t* ghosts;      ///< for each ghost, the index of the original position
  std::size_t ghosts_left;          ///< the number of ghosts in this and all later leaves; limits prefetching
  const std::uint32_t* order;
  const std::uint16_t *neighbours, *lengths;  ///< as in Rings, for this leaf
  float unit;
};

/// Functions that compute sums or positions from weights, for one row form.
struct TileKernel {
  std::size_t sums;  ///< sums per vertex: 12 for moment forms, else the number of columns of a row
  /// Writes the weighted sums of rows to sums [tile][sum][lane].
  void (*blend)(const TileRun& run, float* sums);
  /// Writes positions to out [slot] as x y z x. `rest` and `offsets` are x and o of RowForm, [tile][3][lane].
  void (*apply)(const TileRun& run, const float* rest, const float* offsets, float* out);
};

}  // namespace viete::deform
