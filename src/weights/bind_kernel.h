// Vector code of binding: distances, weights and the compression of weights. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sym3/kernel.h"

namespace viete::weights {

inline constexpr std::size_t bind_lanes = 8;  ///< the number of points that a kernel processes at once

/// A triangle in local coordinates, made by distance_triangle(). The first edge is the longest. The x axis
/// runs along this edge, y points inward, and z is the normal. A point p has the local coordinates axes * p -
/// shift. WeightJob::shifts has the shift of each triangle.
template <class T>
struct DistanceTriangle {
  T axes[3][3];
  T length[3];  ///< edge lengths
  /// Entry k is for edge k + 1. For a point (x, y), dot(along[k], (x, y, 1)) is the coordinate along the
  /// edge, and dot(inward[k], (x, y, 1)) is the distance from the edge's line, positive inside.
  T along[2][3], inward[2][3];
  T outside;  ///< least inward distance of inside points: 0, or infinity if there is no area
  T near;     ///< least squared distance that is accurate in float; about (longest edge / 16)^2
  T share;    ///< see HandleShape::share
};

template <class T>
struct WeightJob {
  const DistanceTriangle<T>* triangles;
  const T (*shifts)[3];
  std::size_t count;
  T least_square;   ///< replaces smaller squared distances; only for inverse distance weights
  T cut;            ///< 1 / (radius of cut-off weights)
  const T* points;  ///< [3][lane]
};

/// The corner indices of a cage triangle, and for each corner the index of the opposite edge.
struct MeanValueTriangle {
  std::uint32_t corner[3], edge[3];
  double sign[3];  ///< 1 if the triangle traverses edge[k] from the lower to the higher index, else -1
};

struct MeanValueJob {
  const double (*corners)[3];  ///< positions, scaled so that the cage's diagonal is 1
  std::size_t corner_count;
  const std::uint32_t (*edges)[2];  ///< corner indices, the lower index first
  std::size_t edge_count;
  const MeanValueTriangle* triangles;  ///< only triangles with area
  std::size_t triangle_count;
  const double* points;  ///< [3][lane]
  double* scratch;       ///< buffer of scratch_size() numbers

  static constexpr std::size_t scratch_size(std::size_t corners, std::size_t edges) {
    return bind_lanes * (4 * corners + 5 * edges);
  }
};

inline constexpr std::size_t space_group = 4;  ///< number of weights that are computed together

/// The weights w_j(x) = constants[j] + sum over i of coefficients[j, i] * k, see SpaceWeights. k is
/// sqrt(|x - centers[i]|^2 + width^2) or its inverse.
struct SpaceJob {
  const double (*centers)[3];
  std::size_t count;           ///< number of centers and of weights; a multiple of space_group
  const double* coefficients;  ///< [j / space_group][i][j % space_group]
  const double* constants;
  double width, threshold;
  bool inverse;
  const double* points;  ///< [3][lane]
  double* scratch;       ///< buffer of count * bind_lanes numbers
};

/// Output for the weights of 16 points (a tile), or for eight points of a tile.
struct RowJob {
  const double (*handles)[3];  ///< positions
  std::size_t count;
  float* rows;              ///< [handle][16 lanes]
  double* sums;             ///< [3][16 lanes]: sum of (weight as float) * (handle position)
  float* totals = nullptr;  ///< [16 lanes], only for cut-off weights: sum of the weights before normalisation
};

/// The weights of a leaf during compression.
struct LeafRows {
  float* rows;  ///< [tile][column][16 lanes], aligned; take_out() replaces the rows by residuals
  std::size_t tiles, columns;
};

struct BindKernel {
  /// Writes inverse distance weights of eight points to weights [triangle][8 lanes]: 1 / d^2 of each handle,
  /// divided by the sum. d is the distance from the point to the handle; distances below the contact distance
  /// count as the contact distance. Uses only ratios of distances, so no length scale overflows.
  void (*inverse_distance)(const WeightJob<double>& job, double* weights);
  /// Fills `rows` with inverse distance weights of 16 points. If a distance is too small or too large for
  /// float precision, returns false and leaves `rows` undefined.
  bool (*inverse_distance_rows)(const WeightJob<float>& job, const RowJob& rows);
  /// Writes cut-off weights of eight points to weights [triangle][lane]: (1 - d / radius)^2 if d < radius,
  /// otherwise 0, divided by the sum. Writes the sums to totals [lane]; if a sum is 0, all weights are 0.
  void (*cut_off)(const WeightJob<double>& job, double* weights, double* totals);
  /// Fills `rows`, including RowJob::totals, with cut-off weights of 16 points. If a distance or a total is
  /// too small for float precision, returns false and leaves `rows` undefined.
  bool (*cut_off_rows)(const WeightJob<float>& job, const RowJob& rows);
  /// Writes mean value weights with the sum 1 to weights [corner][8 lanes]. Returns a bit mask of the lanes
  /// that need mean_value_weights(), because the point is too near to a triangle's plane or the sum is 0.
  unsigned (*mean_value)(const MeanValueJob& job, double* weights);
  /// Writes the weights of eight points in space to weights [handle][8 lanes], see SpaceWeights.
  void (*in_space)(const SpaceJob& job, double* weights);
  /// Writes weights [handle][8 lanes] as floats to eight lanes of rows.rows. Computes rows.sums.
  void (*to_rows)(const double* weights, const RowJob& rows);
  /// Makes each row orthogonal to the unit vector `unit_row`: subtracts coefficients[slot] * unit_row. Writes
  /// `coefficients`, and the squared norm of each new row to squared_norms [slot].
  void (*take_out)(const LeafRows& leaf, const float* unit_row, float* coefficients, float* squared_norms);
  /// Replaces each slot's coefficients u [tile][pivot][lane] by the solution f of f * lower = u. The slot's
  /// row is then the sum of f[k] * (row of pivot k). `lower` is lower triangular, rank x rank, row by row.
  void (*solve)(float* coefficients, std::size_t tiles, std::size_t rank, const float* lower);
};

const BindKernel& bind_kernel(const sym3::Kernel& kernel);

}  // namespace viete::weights
