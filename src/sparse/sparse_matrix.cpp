#include "sparse/sparse_matrix.h"

#include <algorithm>
#include <utility>

namespace viete::sparse {

SparseMatrix sparse_matrix(std::size_t n, std::span<const MatrixEntry> entries) {
  return sparse_matrix_of(n, [&](const auto& add) {
    for (const auto& [row, column, value] : entries) add(row, column, value);
  });
}

SparseMatrix transposed_sum(const SparseMatrix& matrix) {
  SparseMatrix result;
  result.starts.assign(matrix.starts.size(), 0);
  std::vector<std::uint32_t> last(matrix.size());  // the column in which each row was last seen, plus 1
  const auto for_entries = [&](const auto& visit) {
    std::ranges::fill(last, 0);
    for (std::uint32_t v = 0; v < matrix.size(); ++v)
      for_column(matrix, v, [&](std::uint32_t row, double value) {
        visit(v, row, std::exchange(last[row], v + 1) != v + 1, value);
      });
  };
  for_entries([&](auto, std::uint32_t row, bool is_new, double) { result.starts[row + 1] += is_new; });
  std::partial_sum(result.starts.begin(), result.starts.end(), result.starts.begin());
  std::vector<std::int32_t> next(result.starts.begin(), result.starts.end() - 1);
  result.rows.resize(static_cast<std::size_t>(result.starts.back()));
  result.values.resize(result.rows.size());
  for_entries([&](std::uint32_t v, std::uint32_t row, bool is_new, double value) {
    const auto i = static_cast<std::size_t>(is_new ? next[row]++ : next[row] - 1);
    result.rows[i] = static_cast<std::int32_t>(v);
    result.values[i] = is_new ? value : result.values[i] + value;
  });
  return result;
}

SparseMatrix permuted(const SparseMatrix& matrix, const std::vector<std::uint32_t>& places) {
  return sparse_matrix_of(matrix.size(), [&](const auto& add) {
    for (std::uint32_t v = 0; v < matrix.size(); ++v)
      for_column(matrix, v, [&](std::uint32_t row, double value) {
        if (row >= v) add(std::max(places[row], places[v]), std::min(places[row], places[v]), value);
      });
  });
}

mesh::UnionFind connected(const SparseMatrix& matrix) {
  mesh::UnionFind parts(matrix.size());
  for (std::uint32_t v = 0; v < matrix.size(); ++v)
    for_column(matrix, v, [&](std::uint32_t row, double) { parts.join(row, v); });
  return parts;
}

SparseMatrix grounded(const SparseMatrix& matrix, const std::vector<bool>& free) {
  SparseMatrix lower;
  lower.rows.reserve(matrix.rows.size());
  lower.values.reserve(matrix.rows.size());
  const auto add = [&](std::uint32_t row, double value) {
    lower.rows.push_back(static_cast<std::int32_t>(row));
    lower.values.push_back(value);
  };
  for (std::uint32_t v = 0; v < free.size(); ++v) {
    if (!free[v]) add(v, 1);
    for_column(matrix, v, [&](std::uint32_t row, double value) {
      if (free[v] && row >= v && free[row]) add(row, value);
    });
    lower.starts.push_back(static_cast<std::int32_t>(lower.rows.size()));
  }
  return lower;
}

}  // namespace viete::sparse
