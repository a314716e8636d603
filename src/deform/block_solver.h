// A sparse symmetric system that is factored once and solved for many right-hand sides, sixteen at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/aligned.h"
#include "deform/bind_kernel.h"
#include "deform/laplacian.h"

namespace viete::deform {

/// Throws base::Error: that the equations have no solution in double precision.
[[noreturn]] void refuse_system();

/// A = P^T L D L^T P, P for few entries of L (Eigen's SimplicialLDLT with approximate minimum degree). A
/// factor is read once for sixteen right-hand sides, which lie side by side: nine times as fast as Eigen's
/// solve of sixteen columns.
class BlockSolver {
public:
  /// Only the lower triangle is read. Throws base::Error if the matrix is not positive definite in double
  /// precision.
  explicit BlockSolver(const SparseMatrix& matrix);

  std::size_t unknowns() const { return inverse_diagonal_.size(); }
  /// Where the numbers of an unknown are in a block.
  std::size_t place(std::size_t unknown) const { return solved_columns * places_[unknown]; }
  /// Right-hand sides become solutions: block has solved_columns numbers for each unknown, from place() on,
  /// and begins at a cache line.
  void solve(std::span<double> block, const BindKernel& kernel) const;

private:
  std::vector<std::uint32_t> places_;
  std::vector<std::uint32_t> starts_, rows_;  // of the columns of L, without its diagonal of ones
  base::AlignedVector<double> values_;
  std::vector<double> inverse_diagonal_;
};

}  // namespace viete::deform
