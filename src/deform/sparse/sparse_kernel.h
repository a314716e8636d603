// Dense steps of sparse factorisation, and solves, in vector code. Internal.
#pragma once

#include "deform/sparse/sparse_jobs.h"
#include "sym3/kernel.h"

namespace viete::deform {

struct SparseKernel {
  /// block [row][solved_columns], aligned, in place: right-hand sides become solutions.
  void (*solve_columns)(const TriangularFactor& factor, double* block);
  /// The two halves of that, of [row][4]: by L from the left, then by D and L^T. Of a part of the supernodes
  /// that contains the parents of all, they solve for the rows of these.
  void (*forward_four)(const TriangularFactor& factor, double* block);
  void (*backward_four)(const TriangularFactor& factor, double* block);
  /// Columns [begin, end) become those of L, and their pivots D: what earlier columns before `begin` take
  /// from them is taken. Few columns: their number is that of operations for each entry.
  void (*eliminate)(const Front& front, std::size_t begin, std::size_t end, double* pivots);
  /// Of column groups [begin, end).
  void (*subtract_product)(const ProductJob& job, std::size_t begin, std::size_t end);
};

/// That of the same instruction set.
const SparseKernel& sparse_kernel(const sym3::Kernel& kernel);

}  // namespace viete::deform
