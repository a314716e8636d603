// Square sparse matrices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/union_find.h"

namespace viete::deform {

/// A square matrix by compressed columns, as sparse solvers take it: column j has values[i] in row rows[i],
/// starts[j] <= i < starts[j + 1], ascending by row. (Eigen::Map<const Eigen::SparseMatrix<double>> views
/// it.)
struct SparseMatrix {
  std::vector<std::int32_t> starts{0}, rows;
  std::vector<double> values;

  std::size_t size() const { return starts.size() - 1; }
};

struct MatrixEntry {
  std::uint32_t row, column;
  double value;
};
/// n rows and columns of these; entries of the same place are added.
SparseMatrix sparse_matrix(std::size_t n, std::span<const MatrixEntry> entries);

/// The lower triangle of a symmetric matrix, of which the lower triangle counts, with unknown i at places[i].
/// Columns are not sorted.
SparseMatrix permuted(const SparseMatrix& matrix, const std::vector<std::uint32_t>& places);

/// visit(row, value) of each entry of a column.
template <class Visit>
void for_column(const SparseMatrix& matrix, std::uint32_t column, const Visit& visit) {
  for (auto i = matrix.starts[column]; i < matrix.starts[column + 1]; ++i)
    visit(static_cast<std::uint32_t>(matrix.rows[i]), matrix.values[i]);
}

/// The unknowns that hang together by entries.
mesh::UnionFind connected(const SparseMatrix& matrix);

/// The lower triangle of a symmetric matrix in which the equations of all but the free unknowns say what they
/// are.
SparseMatrix grounded(const SparseMatrix& matrix, const std::vector<bool>& free);

}  // namespace viete::deform
