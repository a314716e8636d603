// Binding in vector code: distances, weights, and their compression. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

#include "deform/bind_jobs.h"
#include "sym3/kernel.h"

namespace viete::deform {

struct BindKernel {
  /// weights [triangle][8 lanes]: inverse_distance_weights().
  void (*inverse_distance)(const WeightJob<double>& job, double* weights);
  /// The same of 16 lanes in floats, and their sums. Returns false, rows being of no use, where a point is so
  /// near to a triangle that its distance is not known well enough.
  bool (*inverse_distance_rows)(const WeightJob<float>& job, const RowJob& rows);
  /// weights [triangle][8 lanes]: cut_off_weights(); totals [8 lanes]: what that returns.
  void (*cut_off)(const WeightJob<double>& job, double* weights, double* totals);
  /// As inverse_distance_rows, of these.
  bool (*cut_off_rows)(const WeightJob<float>& job, const RowJob& rows);
  /// weights [corner][lane], each lane summing to 1. Returns a bit for each lane that mean_value_weights()
  /// must decide: its point lies in or next to a triangle's plane, or the weights vanish.
  unsigned (*mean_value)(const MeanValueJob& job, double* weights);
  /// weights [handle][8 lanes] as floats, into eight lanes of the rows, and their sums.
  void (*to_rows)(const double* weights, const RowJob& rows);
  /// coefficients [slot] of a unit row, which is taken out of every row; squared_norms [slot] of what is
  /// left.
  void (*take_out)(const LeafRows& leaf, const float* unit_row, float* coefficients, float* squared_norms);
  /// Coefficients [tile][t][lane] become factors of the pivots' rows, in place: lower is [s][t], rank x rank.
  void (*solve)(float* coefficients, std::size_t tiles, std::size_t rank, const float* lower);
};

/// That of the same instruction set.
const BindKernel& bind_kernel(const sym3::Kernel& kernel);

}  // namespace viete::deform
