// Input and output of the binding kernels. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

namespace viete::deform {

inline constexpr std::size_t bind_lanes = 8;  ///< the number of points that a kernel processes at once

/// A triangle in its own coordinates, see distance_triangle.h. The first edge is the longest; x runs along
/// it, y points inward, z is the normal. A point p has the coordinates axes * p - shift.
template <class T>
struct DistanceTriangle {
  T axes[3][3];
  T length[3];  ///< edge lengths
  /// For the second and third edge: along . (x, y, 1) is the coordinate of a point along the edge, and
  /// inward . (x, y, 1) is the point's distance from the edge line, positive inside.
  T along[2][3], inward[2][3];
  T outside;        ///< 0; infinity if the triangle has no area, so that every point is outside
  T near;           ///< square of about 1/16 of the longest edge; smaller distances are inaccurate in float
  bool degenerate;  ///< true: the triangle has no area, and its weight is 0
};

template <class T>
struct WeightJob {
  const DistanceTriangle<T>* triangles;
  const T (*shifts)[3];
  std::size_t count;
  T least_square;   ///< lower limit of squared distances; only for inverse distance weights
  T cut;            ///< 1 / radius of cut-off weights
  const T* points;  ///< [3][lane]
};

/// A triangle of the cage: its corners, and for each corner the opposite edge.
struct MeanValueTriangle {
  std::uint32_t corner[3], edge[3];
  double sign[3];  ///< 1: the triangle traverses the edge from its first to its second corner; -1: reversed
};

struct MeanValueJob {
  const double (*corners)[3];  ///< positions, scaled so that the cage's diagonal is 1
  std::size_t corner_count;
  const std::uint32_t (*edges)[2];  ///< corner indices, the lower one first
  std::size_t edge_count;
  const MeanValueTriangle* triangles;  ///< only triangles with area
  std::size_t triangle_count;
  const double* points;  ///< [3][lane]
  double* scratch;       ///< buffer of scratch_size() numbers

  static constexpr std::size_t scratch_size(std::size_t corners, std::size_t edges) {
    return bind_lanes * (4 * corners + 5 * edges);
  }
};

/// The weights of a tile of 16 points, or of eight of these points.
struct RowJob {
  const double (*handles)[3];  ///< positions
  std::size_t count;
  float* rows;              ///< [handle][16 lanes]
  double* sums;             ///< [3][16 lanes]: sum of (weight as float) * (handle position)
  float* totals = nullptr;  ///< [16 lanes], only for cut-off weights: sum of the weights before normalisation
};

/// The weights of a leaf during compression.
struct LeafRows {
  float* rows;  ///< [tile][column][16 lanes], aligned; overwritten with the residuals
  std::size_t tiles, columns;
};

}  // namespace viete::deform
