// Dense steps of sparse factorisation, and solves, in vector code. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

#include "deform/sparse/sparse_jobs.h"
#include "sym3/kernel.h"

namespace viete::deform {

struct SparseKernel {
  /// The two halves of a solve, for [row][solved_columns] or [row][4], aligned: forward by L, then backward
  /// by D and L^T. For a subset of the supernodes that is closed under parents, they solve for the rows of
  /// the subset.
  void (*forward_columns)(const TriangularFactor& factor, double* block);
  void (*backward_columns)(const TriangularFactor& factor, double* block);
  void (*forward_four)(const TriangularFactor& factor, double* block);
  void (*backward_four)(const TriangularFactor& factor, double* block);
  /// Turns columns [begin, end) into those of L, and writes their pivots D. The updates by columns before
  /// `begin` must already be subtracted. Meant for few columns: the cost per entry is proportional to their
  /// number.
  void (*eliminate)(const Front& front, std::size_t begin, std::size_t end, double* pivots);
  /// Processes column groups [begin, end).
  void (*subtract_product)(const ProductJob& job, std::size_t begin, std::size_t end);
};

/// The kernel for the same instruction set.
const SparseKernel& sparse_kernel(const sym3::Kernel& kernel);

}  // namespace viete::deform
