// Square sparse matrices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/union_find.h"

namespace viete::deform {

/// A square matrix in compressed columns: column j has values[i] in row rows[i], starts[j] <= i < starts[j +
/// 1], ascending by row. (Eigen::Map<const Eigen::SparseMatrix<double>> can view it.)
struct SparseMatrix {
  std::vector<std::int32_t> starts{0}, rows;
  std::vector<double> values;

  std::size_t size() const { return starts.size() - 1; }
};

struct MatrixEntry {
  std::uint32_t row, column;
  double value;
};
/// n x n matrix of these entries; entries at the same position are added.
SparseMatrix sparse_matrix(std::size_t n, std::span<const MatrixEntry> entries);

/// The lower triangle of a symmetric matrix (only its lower triangle is read) with unknown i moved to
/// places[i]. Columns are not sorted.
SparseMatrix permuted(const SparseMatrix& matrix, const std::vector<std::uint32_t>& places);

/// Calls visit(row, value) for each entry of a column.
template <class Visit>
void for_column(const SparseMatrix& matrix, std::uint32_t column, const Visit& visit) {
  for (auto i = matrix.starts[column]; i < matrix.starts[column + 1]; ++i)
    visit(static_cast<std::uint32_t>(matrix.rows[i]), matrix.values[i]);
}

/// Unknowns connected by entries.
mesh::UnionFind connected(const SparseMatrix& matrix);

/// The lower triangle of a symmetric matrix with the rows and columns of all unknowns that are not free
/// replaced by those of the identity.
SparseMatrix grounded(const SparseMatrix& matrix, const std::vector<bool>& free);

}  // namespace viete::deform
