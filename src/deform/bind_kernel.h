// Binding in vector code: distances, weights, and their compression. Internal.
#pragma once

#include <cstddef>

#include "sym3/kernel.h"

namespace viete::deform {

inline constexpr std::size_t bind_lanes = 8;  ///< points at once

/// A triangle as distances to it are computed: no division, no region.
struct DistanceTriangle {
  double corner[3][3];
  double edge[3][3];       ///< from corner i to corner i + 1
  double inverse[3];       ///< 1 / |edge|^2; 0 for an edge without length
  double normal[3];        ///< unit; 0 where there is no area, and then `inward` is such that nothing is inside
  double inward[3][3];     ///< in the plane, at a right angle to the edge
  double outside;          ///< 0; 1 where nothing is inside
  double degenerate;       ///< 0; 1 for an element without influence
};

struct WeightJob {
  const DistanceTriangle* triangles;
  std::size_t count;
  double squared_contact;
  const double* points;  ///< [3][lane]
};

/// Eight of the sixteen lanes of a tile of weights.
struct RowJob {
  const double* weights;          ///< [handle][lane]
  const double (*handles)[3];     ///< positions
  std::size_t count;
  float* rows;                    ///< [handle][16 lanes], the first of the eight
  double* sums;                   ///< [3][lane]: sum of weight times position, of the weights as floats
};

/// A leaf that is being compressed.
struct LeafRows {
  float* rows;  ///< [tile][column][16 lanes], aligned; what is left of them
  std::size_t tiles, columns;
};

struct BindKernel {
  /// weights [triangle][lane]: d^-2 over the sum of all, d no less than contact.
  void (*inverse_distance)(const WeightJob& job, double* weights);
  /// Weights as floats, and their sums.
  void (*to_rows)(const RowJob& job);
  /// coefficients [slot] of a unit row, which is taken out of every row; squared_norms [slot] of what is left.
  void (*take_out)(const LeafRows& leaf, const float* unit_row, float* coefficients, float* squared_norms);
  /// Coefficients [tile][t][lane] become factors of the pivots' rows, in place: lower is [s][t], rank x rank.
  void (*solve)(float* coefficients, std::size_t tiles, std::size_t rank, const float* lower);
};

/// That of the same instruction set.
const BindKernel& bind_kernel(const sym3::Kernel& kernel);

}  // namespace viete::deform
