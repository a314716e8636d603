// A sparse symmetric system that is factored once and solved for three right-hand sides a frame.
#pragma once

#include <cstddef>
#include <span>

#include "base/aligned.h"
#include "base/worker_pool.h"
#include "deform/sparse/sparse_factor.h"
#include "deform/sparse/sparse_matrix.h"
#include "mesh/vector.h"

namespace viete::deform {

/// A SparseFactor that all columns of a right-hand side go through at once. Constant once it is made; solve()
/// is thread-safe as long as each thread has a workspace of its own.
class SparseCholesky {
public:
  /// Three numbers a row, padded to a vector.
  struct alignas(32) Row {
    double x[4];
  };
  using Workspace = base::AlignedVector<Row>;

  /// Of a symmetric matrix, of which the lower half counts. Throws base::Error, saying which row, where it is
  /// not positive definite up to rounding or not finite; what report throws.
  explicit SparseCholesky(const SparseMatrix& matrix, base::WorkerPool& pool,
                          const FactorReport& report = {});

  std::size_t size() const { return factor_.size(); }
  /// Off the diagonal, with the zeros that are kept among them.
  std::size_t entries() const { return factor_.values.size(); }

  /// A x = b for three columns at once; b and x may be the same. Sizes: size().
  void solve(std::span<const mesh::Vec3> b, std::span<mesh::Vec3> x, Workspace& work) const;

private:
  SparseFactor factor_;
};

}  // namespace viete::deform
