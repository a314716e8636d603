// Square sparse matrices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/union_find.h"

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

/// Moves unknown i of a symmetric matrix to places[i]. Reads and returns only the lower triangle. In the
/// columns of the result, the rows are not in ascending order.
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

}  // namespace viete::sparse
