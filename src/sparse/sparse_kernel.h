// Vector code for the dense steps of sparse factorisation and for solves. Internal.
#pragma once

#include <cstddef>

#include "sparse/sparse_jobs.h"
#include "sym3/kernel.h"

namespace viete::sparse {

struct SparseKernel {
  /// The two halves of a solve: first forward with L, then backward with D and L^T. The block is aligned, and
  /// is [row][solved_columns] or [row][4]. If the factor has only some supernodes, only their rows are
  /// solved. All ancestors of these supernodes must then be in the factor.
  void (*forward_columns)(const TriangularFactor& factor, double* block);
  void (*backward_columns)(const TriangularFactor& factor, double* block);
  void (*forward_four)(const TriangularFactor& factor, double* block);
  void (*backward_four)(const TriangularFactor& factor, double* block);
  /// Converts the columns [begin, end) to columns of L, and writes the pivots D of these columns. The updates
  /// by columns before `begin` must already be subtracted. Use few columns at once, because the cost per
  /// entry is proportional to the number of columns.
  void (*eliminate)(const Front& front, std::size_t begin, std::size_t end, double* pivots);
  /// Runs the job for the column groups [begin, end).
  void (*subtract_product)(const ProductJob& job, std::size_t begin, std::size_t end);
};

/// Returns the functions for the instruction set of `kernel`.
const SparseKernel& sparse_kernel(const sym3::Kernel& kernel);

}  // namespace viete::sparse
