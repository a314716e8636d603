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
#include "deform/sparse/sparse_kernel.h"
#include "deform/sparse/sparse_matrix.h"
#include "deform/sparse/symbolic_factor.h"
#include "mesh/vector.h"
#include "sym3/kernel.h"

namespace viete::deform {

/// P A P^T = L D L^T, L with a unit diagonal; the i-th eliminated unknown is order[i].
struct SparseFactor : SymbolicFactor {
  base::AlignedVector<double> values;   // entries of L
  std::vector<double> pivots, inverse;  // D, and 1 / D

  std::size_t size() const { return order.size(); }
  /// The factor, or a part of it, in the form that the kernels take.
  TriangularFactor view() const { return view(supernodes); }
  TriangularFactor view(std::span<const Supernode> part) const {
    return {part.data(), part.size(), rows.data(), values.data(), inverse.data()};
  }
  /// The supernodes of some unknowns and their ancestors; places: the order inverted.
  std::vector<Supernode> part_above(std::span<const std::uint32_t> unknowns,
                                    std::span<const std::uint32_t> places) const;
};

/// Maps progress of a factorisation to [from, to] of `progress`, which may be null.
FactorReport told(base::Progress* progress, double from, double to);

/// The multifrontal method (I. S. Duff and J. K. Reid, ACM Trans. Math. Softw. 9, 1983) with the supernodes
/// of analyse(), in the given order or that of elimination_order(). No pivoting and no error: if the matrix
/// is not positive definite in double precision, a pivot is NaN, zero or negative. Reads only the lower
/// triangle. Calls report at least once per few million operations. The same bits for any number of threads.
/// Throws std::bad_alloc and the exceptions that report throws.
SparseFactor factor(const SparseMatrix& matrix, base::WorkerPool& pool, const FactorReport& report = {});
SparseFactor factor(const SparseMatrix& matrix, const mesh::Adjacency& neighbours,
                    std::vector<std::uint32_t> order, base::WorkerPool& pool, const FactorReport& report = {},
                    const SparseKernel& kernel = sparse_kernel(sym3::kernel()));

/// A SparseFactor that solves all columns of a right-hand side at once. Constant after construction; solve()
/// is thread-safe with one workspace per thread.
class SparseCholesky {
public:
  struct Workspace {
    base::AlignedVector<double> rows, part;  // four numbers per unknown
  };

  /// Reads only the lower triangle of a symmetric matrix. Throws base::Error with the row if the matrix is
  /// not finite or not positive definite up to rounding, and the exceptions that report throws.
  explicit SparseCholesky(const SparseMatrix& matrix, base::WorkerPool& pool,
                          const FactorReport& report = {});

  std::size_t size() const { return factor_.size(); }

  /// A x = b for three columns at once; b and x may be the same. Sizes: size().
  void solve(std::span<const mesh::Vec3> b, std::span<mesh::Vec3> x, Workspace& work) const;
  /// Solves A x = b + c, where c is 0 except at `some` unknowns and depends on their values in the solution
  /// of A x = b: correct() reads these from x and writes c to b, which is 0 there. Unknowns eliminated before
  /// `some` are forward-solved only once.
  void solve_corrected(std::span<mesh::Vec3> b, std::span<mesh::Vec3> x, std::span<const std::uint32_t> some,
                       const std::function<void()>& correct, Workspace& work) const;

private:
  void read(std::span<const mesh::Vec3> b, Workspace& work) const;
  void write(const Workspace& work, std::span<mesh::Vec3> x) const;

  SparseFactor factor_;
  std::vector<std::uint32_t> places_;  // of the unknowns, in the order
};

/// Throws base::Error: the equations have no solution in double precision.
[[noreturn]] void refuse_system();

/// Solves sixteen adjacent right-hand sides per pass over the factor.
class BlockSolver {
public:
  /// Reads only the lower triangle. Throws base::Error if the matrix is not positive definite in double
  /// precision, and the exceptions that report throws.
  explicit BlockSolver(const SparseMatrix& matrix, base::WorkerPool& pool, const FactorReport& report = {});

  std::size_t unknowns() const { return factor_.size(); }
  const std::vector<std::uint32_t>& order() const { return factor_.order; }  ///< of the rows of a block
  /// Offset of an unknown's numbers in a block.
  std::size_t place(std::size_t unknown) const { return solved_columns * places_[unknown]; }
  /// Replaces right-hand sides by solutions: block has solved_columns numbers per unknown, from place() on,
  /// aligned to a cache line. With a part, solves only for the unknowns of part_with(). Thread-safe.
  void solve(std::span<double> block, const SparseKernel& kernel,
             const std::vector<Supernode>* part = nullptr) const;
  std::vector<Supernode> part_with(std::span<const std::uint32_t> unknowns) const;

private:
  SparseFactor factor_;
  std::vector<std::uint32_t> places_;
};

}  // namespace viete::deform
