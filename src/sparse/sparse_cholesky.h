// Cholesky factorisation of sparse symmetric matrices on all threads, and solves with many right-hand sides.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/memory.h"
#include "base/progress.h"
#include "base/worker_pool.h"
#include "mesh/vector.h"
#include "sparse/sparse_kernel.h"
#include "sparse/sparse_matrix.h"
#include "sym3/kernel.h"

namespace viete::sparse {

/// The factors of P * A * P^T = L * D * L^T. L has a unit diagonal. The i-th eliminated unknown is order[i].
struct SparseFactor : SymbolicFactor {
  base::AlignedVector<double> values;   // entries of L
  std::vector<double> pivots, inverse;  // D, and 1 / D

  std::size_t size() const { return order.size(); }
  /// Views of the factor, or of a part of its supernodes, for the kernels.
  TriangularFactor view() const { return view(supernodes); }
  TriangularFactor view(std::span<const Supernode> part) const {
    return {part.data(), part.size(), rows.data(), values.data(), inverse.data()};
  }
  /// Returns the supernodes of these unknowns, and all ancestors. `places` is the inverse of `order`.
  std::vector<Supernode> part_above(std::span<const std::uint32_t> unknowns,
                                    std::span<const std::uint32_t> places) const;
};

/// Returns a report function that maps a factorisation's progress to [from, to] of `progress` (may be null).
FactorReport told(base::Progress* progress, double from, double to);

/// Factors a symmetric matrix by the multifrontal method (I. S. Duff and J. K. Reid, ACM Trans. Math. Softw.
/// 9, 1983), in the given order or in elimination_order(). Reads only the lower triangle. Does not pivot: if
/// the matrix is not positive definite in double precision, a pivot is NaN, zero or negative. Calls `report`
/// at least once per few million operations. The result does not depend on the number of threads. Throws
/// std::bad_alloc and the exceptions that `report` throws.
SparseFactor factor(const SparseMatrix& matrix, base::WorkerPool& pool, const FactorReport& report = {});
SparseFactor factor(const SparseMatrix& matrix, const mesh::Adjacency& neighbours,
                    std::vector<std::uint32_t> order, base::WorkerPool& pool, const FactorReport& report = {},
                    const SparseKernel& kernel = sparse_kernel(sym3::kernel()));

/// Solves A * x = b for three columns at once. Thread-safe with one workspace per thread.
class SparseCholesky {
public:
  struct Workspace {
    base::AlignedVector<double> rows, part;  // four numbers per unknown
  };

  /// Reads only the lower triangle of a symmetric matrix. Throws base::Error, which names the row, if the
  /// matrix is not finite or not positive definite up to rounding. Also throws what `report` throws.
  explicit SparseCholesky(const SparseMatrix& matrix, base::WorkerPool& pool,
                          const FactorReport& report = {});

  std::size_t size() const { return factor_.size(); }

  /// Solves A * x = b. b and x have size() entries and may be one array.
  void solve(std::span<const mesh::Vec3> b, std::span<mesh::Vec3> x, Workspace& work) const;
  /// Solves A * x = b + c in less time than two solves. c may depend on the solution of A * x = b, and is
  /// nonzero only at the unknowns in `some`. For these unknowns, first writes the solution of A * x = b to x,
  /// and sets b to 0. Then calls correct(), which must write c to b.
  void solve_corrected(std::span<mesh::Vec3> b, std::span<mesh::Vec3> x, std::span<const std::uint32_t> some,
                       const std::function<void()>& correct, Workspace& work) const;

private:
  void read(std::span<const mesh::Vec3> b, Workspace& work) const;
  void write(const Workspace& work, std::span<mesh::Vec3> x) const;

  SparseFactor factor_;
  std::vector<std::uint32_t> places_;  // the place of each unknown in the elimination order
};

/// Throws base::Error, which says that the equations have no solution in double precision.
[[noreturn]] void refuse_system();

/// Solves A * x = b for sixteen columns at once.
class BlockSolver {
public:
  /// Reads only the lower triangle. Throws base::Error if the matrix is not positive definite in double
  /// precision, and the exceptions that report throws.
  explicit BlockSolver(const SparseMatrix& matrix, base::WorkerPool& pool, const FactorReport& report = {});

  std::size_t unknowns() const { return factor_.size(); }
  const std::vector<std::uint32_t>& order() const { return factor_.order; }  ///< order of the rows of a block
  /// Returns the offset of an unknown's numbers in a block.
  std::size_t row_of(std::size_t unknown) const { return solved_columns * places_[unknown]; }
  /// Solves for `columns` columns, sixteen at a time. From any thread of the pool, calls act(begin, end,
  /// block) for columns [begin, end), with a block of zeros. A block has solved_columns numbers per unknown,
  /// beginning at row_of(). Reports the fraction of columns that are done.
  using Act = std::function<void(std::size_t begin, std::size_t end, std::span<double> block)>;
  void for_blocks(std::size_t columns, base::WorkerPool& pool, const FactorReport& report,
                  const Act& act) const;
  /// Supernodes and all their ancestors.
  using Part = std::vector<Supernode>;
  /// Returns the supernodes of these unknowns, and all ancestors.
  Part part_with(std::span<const std::uint32_t> unknowns) const;
  /// Replaces the right-hand sides in a block, which is aligned to a cache line, by solutions. If `given` is
  /// not null, right-hand sides must be 0 outside of this part. If `wanted` is not null, solves only for its
  /// unknowns. Thread-safe.
  void solve(std::span<double> block, const SparseKernel& kernel, const Part* given = nullptr,
             const Part* wanted = nullptr) const;

private:
  SparseFactor factor_;
  std::vector<std::uint32_t> places_;
};

}  // namespace viete::sparse
