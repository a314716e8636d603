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

/// P A P^T = L D L^T, L with ones on its diagonal: what is eliminated i-th is unknown order[i].
struct SparseFactor : SymbolicFactor {
  base::AlignedVector<double> values;   // of L
  std::vector<double> pivots, inverse;  // D, and 1 / D

  std::size_t size() const { return order.size(); }
  /// How the kernels take it.
  TriangularFactor view() const {
    return {supernodes.data(), supernodes.size(), rows.data(), values.data(), inverse.data()};
  }
};

/// Tells `progress`, which may be null, what part of [from, to] is done.
FactorReport told(base::Progress* progress, double from, double to);

/// The multifrontal method (I. S. Duff and J. K. Reid, ACM Trans. Math. Softw. 9, 1983) by the supernodes
/// of analyse(), in the given order or that of elimination_order(). Nothing is pivoted, and
/// nothing refused: where the matrix is not positive definite in double precision, a pivot is not above 0, or
/// no number. Only the lower triangle is read. report is called at least once in some millions of operations.
/// The same bits for any number of threads. Throws what report throws; std::bad_alloc.
SparseFactor factor(const SparseMatrix& matrix, base::WorkerPool& pool, const FactorReport& report = {});
SparseFactor factor(const SparseMatrix& matrix, const mesh::Adjacency& neighbours,
                    std::vector<std::uint32_t> order, base::WorkerPool& pool, const FactorReport& report = {},
                    const SparseKernel& kernel = sparse_kernel(sym3::kernel()));

/// A SparseFactor that all columns of a right-hand side go through at once. Constant once it is made; solve()
/// is thread-safe as long as each thread has a workspace of its own.
class SparseCholesky {
public:
  struct Workspace {
    base::AlignedVector<double> rows, part;  // four numbers an unknown
    std::vector<Supernode> nodes;            // of the part
    std::vector<std::uint8_t> seen;          // supernodes
  };

  /// Of a symmetric matrix, of which the lower half counts. Throws base::Error, saying which row, where it is
  /// not positive definite up to rounding or not finite; what report throws.
  explicit SparseCholesky(const SparseMatrix& matrix, base::WorkerPool& pool,
                          const FactorReport& report = {});

  std::size_t size() const { return factor_.size(); }
  /// Off the diagonal, with the zeros that are kept among them.
  std::size_t entries() const { return factor_.values.size(); }

  /// A x = b for three columns at once; b and x may be the same. Sizes: size().
  void solve(std::span<const mesh::Vec3> b, std::span<mesh::Vec3> x, Workspace& work) const;
  /// A x = b + c for a c that is 0 but at some unknowns and made of x there as it is without c: correct()
  /// finds that in x and leaves c in b, where it finds 0. What is eliminated before those unknowns is solved
  /// for once.
  void solve_corrected(std::span<mesh::Vec3> b, std::span<mesh::Vec3> x, std::span<const std::uint32_t> some,
                       const std::function<void()>& correct, Workspace& work) const;

private:
  void read(std::span<const mesh::Vec3> b, Workspace& work) const;
  void write(const Workspace& work, std::span<mesh::Vec3> x) const;
  void find_part(std::span<const std::uint32_t> some, Workspace& work) const;

  SparseFactor factor_;
  std::vector<std::uint32_t> places_, nodes_;  // of unknowns: in the order, and their supernodes
};

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
