// Vector code of binding: distances, weights and the compression of weights. Internal.
#pragma once

#include <cstddef>

#include "deform/bind_jobs.h"
#include "sym3/kernel.h"

namespace viete::deform {

struct BindKernel {
  /// Computes inverse_distance_weights() of eight points: weights [triangle][8 lanes].
  void (*inverse_distance)(const WeightJob<double>& job, double* weights);
  /// Computes the inverse distance weights of 16 points as floats, and the sums in RowJob. If a point is too
  /// near to a triangle for an accurate distance, returns false and leaves the rows undefined.
  bool (*inverse_distance_rows)(const WeightJob<float>& job, const RowJob& rows);
  /// Computes cut_off_weights() of eight points: weights [triangle][8 lanes], and the sums totals [8 lanes].
  void (*cut_off)(const WeightJob<double>& job, double* weights, double* totals);
  /// Does for cut-off weights what inverse_distance_rows() does.
  bool (*cut_off_rows)(const WeightJob<float>& job, const RowJob& rows);
  /// Computes mean value weights [corner][8 lanes] that sum to 1 per lane. Returns a bit mask of lanes that
  /// need mean_value_weights(), because the point is too near to a triangle's plane or the sum is 0.
  unsigned (*mean_value)(const MeanValueJob& job, double* weights);
  /// Converts weights [handle][8 lanes] to floats, writes them to eight lanes of the rows, and computes sums.
  void (*to_rows)(const double* weights, const RowJob& rows);
  /// Subtracts from each row the row's projection on a unit row. Writes the coefficients [slot] of the
  /// projections, and the squared norms [slot] of the residuals.
  void (*take_out)(const LeafRows& leaf, const float* unit_row, float* coefficients, float* squared_norms);
  /// Replaces coefficients [tile][pivot][lane] by the factors of the pivots' rows. `lower` is the lower
  /// triangular matrix of the pivots, rank x rank, row by row.
  void (*solve)(float* coefficients, std::size_t tiles, std::size_t rank, const float* lower);
};

/// The binding kernel for the instruction set of `kernel`.
const BindKernel& bind_kernel(const sym3::Kernel& kernel);

}  // namespace viete::deform
