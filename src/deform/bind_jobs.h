// The data that binding kernels work on. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

namespace viete::deform {

inline constexpr std::size_t bind_lanes = 8;  ///< points at once

/// A triangle in coordinates of its own, see distance_triangle.h: x along its longest edge, here its first, y
/// inward, z along its normal. A point has the coordinates axes . point - shift there.
template <class T>
struct DistanceTriangle {
  T axes[3][3];
  T length[3];  ///< edge lengths
  /// Coordinates of a point along the second and third edge, along . (x, y, 1), and to the left of it,
  /// inward . (x, y, 1).
  T along[2][3], inward[2][3];
  T outside;        ///< 0; infinity without area: no point is inside
  T near;           ///< squared, about a sixteenth of the longest edge; nearer distances lose digits in float
  bool degenerate;  ///< has no weight
};

template <class T>
struct WeightJob {
  const DistanceTriangle<T>* triangles;
  const T (*shifts)[3];
  std::size_t count;
  T least_square;   ///< squared contact distance, for inverse distances
  T cut;            ///< 1 / radius, for cut-off weights
  const T* points;  ///< [3][lane]
};

/// A triangle of the cage by its corners and the edges opposite to them.
struct MeanValueTriangle {
  std::uint32_t corner[3], edge[3];
  double sign[3];  ///< 1 if it traverses the edge from the lower corner index to the higher, else -1
};

struct MeanValueJob {
  const double (*corners)[3];  ///< positions, the cage's diagonal being 1
  std::size_t corner_count;
  const std::uint32_t (*edges)[2];  ///< the lower corner first
  std::size_t edge_count;
  const MeanValueTriangle* triangles;  ///< triangles with area
  std::size_t triangle_count;
  const double* points;  ///< [3][lane]
  double* scratch;       ///< scratch_size() numbers

  static constexpr std::size_t scratch_size(std::size_t corners, std::size_t edges) {
    return bind_lanes * (4 * corners + 5 * edges);
  }
};

/// A tile of weights, or eight lanes of it.
struct RowJob {
  const double (*handles)[3];  ///< positions
  std::size_t count;
  float* rows;              ///< [handle][16 lanes]
  double* sums;             ///< [3][16 lanes]: sums of weight times position, with weights as floats
  float* totals = nullptr;  ///< [16 lanes], for cut-off weights: their sums before normalisation
};

/// A leaf during compression.
struct LeafRows {
  float* rows;  ///< [tile][column][16 lanes], aligned; replaced by residuals
  std::size_t tiles, columns;
};

}  // namespace viete::deform
