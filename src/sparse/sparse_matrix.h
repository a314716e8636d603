// Square sparse matrices, and the symbolic factorisation of symmetric ones: elimination order and positions
// of the factor's entries.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <span>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/union_find.h"
#include "sparse/sparse_kernel.h"

namespace viete::sparse {

/// A square matrix in compressed columns. For starts[j] <= i < starts[j + 1], column j has values[i] in row
/// rows[i]. The rows ascend. (Eigen::Map<const Eigen::SparseMatrix<double>> can view these arrays.)
struct SparseMatrix {
  std::vector<std::int32_t> starts{0}, rows;
  std::vector<double> values;

  std::size_t size() const { return starts.size() - 1; }
};

struct MatrixEntry {
  std::uint32_t row, column;
  double value;
};
/// Returns the n x n matrix with these entries. Adds up entries at equal positions.
SparseMatrix sparse_matrix(std::size_t n, std::span<const MatrixEntry> entries);
/// Returns the transposed matrix. Columns of `matrix` may contain a row several times, in any order; these
/// entries are added up.
SparseMatrix transposed_sum(const SparseMatrix& matrix);
/// Works like sparse_matrix(), without a list of entries. for_each(add) must call add(row, column, value) for
/// each entry. It is called twice, and must add the same entries in the same order.
template <class ForEach>
SparseMatrix sparse_matrix_of(std::size_t n, const ForEach& for_each) {
  SparseMatrix rows;  // column i lists row i of the result
  rows.starts.assign(n + 1, 0);
  for_each([&](std::uint32_t row, std::uint32_t, double) { ++rows.starts[row + 1]; });
  std::partial_sum(rows.starts.begin(), rows.starts.end(), rows.starts.begin());
  std::vector<std::int32_t> next(rows.starts.begin(), rows.starts.end() - 1);
  rows.rows.resize(static_cast<std::size_t>(rows.starts.back()));
  rows.values.resize(rows.rows.size());
  for_each([&](std::uint32_t row, std::uint32_t column, double value) {
    const auto i = static_cast<std::size_t>(next[row]++);
    rows.rows[i] = static_cast<std::int32_t>(column);
    rows.values[i] = value;
  });
  return transposed_sum(rows);
}

/// Moves unknown i of a symmetric matrix to places[i]. Reads and returns only the lower triangle.
SparseMatrix permuted(const SparseMatrix& matrix, const std::vector<std::uint32_t>& places);

/// Calls visit(row, value) for each entry of a column.
template <class Visit>
void for_column(const SparseMatrix& matrix, std::uint32_t column, const Visit& visit) {
  for (auto i = matrix.starts[column]; i < matrix.starts[column + 1]; ++i)
    visit(static_cast<std::uint32_t>(matrix.rows[i]), matrix.values[i]);
}

/// Returns the sets of unknowns that are connected by entries.
mesh::UnionFind connected(const SparseMatrix& matrix);

/// Fixes the unknowns that are not free: replaces their rows and columns by those of the identity. The matrix
/// must be symmetric. Returns its lower triangle.
SparseMatrix grounded(const SparseMatrix& matrix, const std::vector<bool>& free);

/// Is called often with the progress in [0, 1], from any thread of the pool. If it throws, the work ends.
using FactorReport = std::function<void(double)>;

/// Returns the neighbours of each unknown: two unknowns with an entry in the lower triangle are neighbours.
mesh::Adjacency neighbours_of_unknowns(const SparseMatrix& matrix);

/// Returns an elimination order with little fill-in, by approximate minimum degree (P. R. Amestoy, T. A.
/// Davis, I. S. Duff, 1996; Eigen's implementation). Takes 0.04 s for 100,000 unknowns, and cannot be
/// interrupted.
std::vector<std::uint32_t> elimination_order(const mesh::Adjacency& neighbours);

inline constexpr std::uint32_t no_parent = 0xffffffff;

/// The entries of a factor L, grouped into supernodes. A supernode is a group of consecutive columns with
/// entries in nearly the same rows. Supernodes are in postorder: each subtree is contiguous, its root last.
struct SymbolicFactor {
  std::vector<std::uint32_t> order;  // unknowns in elimination order
  std::vector<Supernode> supernodes;
  std::vector<std::uint32_t> rows;     // per supernode: rows below its own columns, ascending
  std::vector<std::uint32_t> parents;  // parent of each supernode, or no_parent
  mesh::Adjacency children;
  std::size_t entries = 0;  // the total number of entries of L
};

/// Returns the position of each unknown in an order.
std::vector<std::uint32_t> inverted(const std::vector<std::uint32_t>& order);

/// Finds the elimination tree (J. W. H. Liu, SIAM J. Matrix Anal. Appl. 11, 1990) and the supernodes (C.
/// Ashcraft and R. Grimes, ACM Trans. Math. Softw. 15, 1989). Changes the order to a postorder of the tree,
/// which has equal fill-in. Throws std::bad_alloc and the exceptions that report throws.
SymbolicFactor analyse(const mesh::Adjacency& neighbours, std::vector<std::uint32_t> order,
                       const FactorReport& report);

}  // namespace viete::sparse
