// Binding in vector code: distances, weights and their compression. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

#include "deform/bind_jobs.h"
#include "sym3/kernel.h"

namespace viete::deform {

struct BindKernel {
  /// weights [triangle][8 lanes]: inverse_distance_weights().
  void (*inverse_distance)(const WeightJob<double>& job, double* weights);
  /// The same for 16 lanes in floats, with their sums. Returns false, with rows undefined, if a point is too
  /// near to a triangle for an accurate distance.
  bool (*inverse_distance_rows)(const WeightJob<float>& job, const RowJob& rows);
  /// weights [triangle][8 lanes]: cut_off_weights(); totals [8 lanes]: its return values.
  void (*cut_off)(const WeightJob<double>& job, double* weights, double* totals);
  /// As inverse_distance_rows, for cut-off weights.
  bool (*cut_off_rows)(const WeightJob<float>& job, const RowJob& rows);
  /// weights [corner][lane], each lane with sum 1. Returns a bit mask of lanes that need
  /// mean_value_weights(): their point lies in or next to a triangle's plane, or the weights vanish.
  unsigned (*mean_value)(const MeanValueJob& job, double* weights);
  /// weights [handle][8 lanes] as floats, into eight lanes of the rows, and their sums.
  void (*to_rows)(const double* weights, const RowJob& rows);
  /// Subtracts from every row its projection on a unit row: coefficients [slot] of the projection,
  /// squared_norms [slot] of the residuals.
  void (*take_out)(const LeafRows& leaf, const float* unit_row, float* coefficients, float* squared_norms);
  /// Turns coefficients [tile][t][lane] into factors of the pivots' rows, in place: lower is [s][t], rank x
  /// rank.
  void (*solve)(float* coefficients, std::size_t tiles, std::size_t rank, const float* lower);
};

/// The kernel for the same instruction set.
const BindKernel& bind_kernel(const sym3::Kernel& kernel);

}  // namespace viete::deform
