// A sparse symmetric system that is factored once and solved for three right-hand sides a frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/aligned.h"
#include "deform/laplacian.h"

namespace viete::deform {

/// P A P^T = L D L^T, L unit lower triangular, P an ordering of approximate minimum degree: the factors that
/// Eigen's SimplicialLDLT computes (P. R. Amestoy, T. A. Davis, I. S. Duff, 1996, 2004), here as flat arrays
/// that all columns of a right-hand side go through at once. Constant once it is made; solve() is thread-safe
/// as long as each thread has a workspace of its own.
class SparseCholesky {
public:
  /// Three numbers a row, padded to a vector.
  struct alignas(32) Row {
    double x[4];
  };
  using Workspace = base::AlignedVector<Row>;

  /// Of a symmetric matrix, of which the lower half counts. Throws base::Error, saying which row, where it is
  /// not positive definite up to rounding or not finite.
  explicit SparseCholesky(const SparseMatrix& matrix);

  std::size_t size() const { return rows_of_.size(); }
  /// Off the diagonal.
  std::size_t entries() const { return values_.size(); }

  /// A x = b for three columns at once; b and x may be the same. Sizes: size().
  void solve(std::span<const Vec3> b, std::span<Vec3> x, Workspace& work) const;

private:
  void solve_lower(Row* rows) const;
  void solve_upper(Row* rows) const;

  std::vector<std::uint32_t> rows_of_;  // of the matrix, in the order that they are eliminated in
  std::vector<std::uint32_t> starts_, below_;
  base::AlignedVector<double> values_;  // L by columns
  std::vector<double> inverse_pivots_;  // 1 / D
};

}  // namespace viete::deform
