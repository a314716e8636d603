// Vector code of binding: distances, weights and the compression of weights. Internal.
#pragma once

#include <cstddef>

#include "sym3/kernel.h"
#include "weights/bind_jobs.h"

namespace viete::weights {

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
