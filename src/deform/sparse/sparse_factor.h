// The factors of a sparse symmetric matrix: dense blocks, in vector code, on all threads, and told to stop at
// any time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/aligned.h"
#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/sparse/sparse_kernel.h"
#include "deform/sparse/sparse_matrix.h"
#include "deform/sparse/symbolic_factor.h"
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

}  // namespace viete::deform
