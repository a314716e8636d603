// A sparse symmetric system that is factored once and solved for many right-hand sides, sixteen at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "deform/sparse/sparse_factor.h"
#include "deform/sparse/sparse_kernel.h"
#include "deform/sparse/sparse_matrix.h"

namespace viete::deform {

/// Throws base::Error: that the equations have no solution in double precision.
[[noreturn]] void refuse_system();

/// A factor is read once for sixteen right-hand sides, which lie side by side.
class BlockSolver {
public:
  /// Only the lower triangle is read. Throws base::Error if the matrix is not positive definite in double
  /// precision; what report throws.
  explicit BlockSolver(const SparseMatrix& matrix, base::WorkerPool& pool, const FactorReport& report = {});

  std::size_t unknowns() const { return factor_.size(); }
  /// Where the numbers of an unknown are in a block.
  std::size_t place(std::size_t unknown) const { return solved_columns * places_[unknown]; }
  /// Right-hand sides become solutions: block has solved_columns numbers for each unknown, from place() on,
  /// and begins at a cache line. Thread-safe.
  void solve(std::span<double> block, const SparseKernel& kernel) const;

private:
  SparseFactor factor_;
  std::vector<std::uint32_t> places_;
};

}  // namespace viete::deform
