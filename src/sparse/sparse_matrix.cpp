#include "sparse/sparse_matrix.h"

#include <Eigen/SparseCore>
#include <algorithm>

namespace viete::sparse {

namespace {

using EigensMatrix = Eigen::SparseMatrix<double>;

SparseMatrix ours(const EigensMatrix& matrix) {
  const auto count = matrix.nonZeros();
  return {{matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.outerSize() + 1},
          {matrix.innerIndexPtr(), matrix.innerIndexPtr() + count},
          {matrix.valuePtr(), matrix.valuePtr() + count}};
}

}  // namespace

SparseMatrix sparse_matrix(std::size_t n, std::span<const MatrixEntry> entries) {
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(entries.size());
  for (const auto& e : entries)
    triplets.emplace_back(static_cast<int>(e.row), static_cast<int>(e.column), e.value);
  const auto size = static_cast<int>(n);
  EigensMatrix matrix(size, size);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return ours(matrix);
}

SparseMatrix permuted(const SparseMatrix& matrix, const std::vector<std::uint32_t>& places) {
  const auto n = static_cast<int>(matrix.size());
  const Eigen::Map<const EigensMatrix> view(n, n, matrix.starts.back(), matrix.starts.data(),
                                            matrix.rows.data(), matrix.values.data());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation(n);
  std::ranges::copy(places, permutation.indices().data());
  EigensMatrix result(n, n);
  result.selfadjointView<Eigen::Lower>() = view.selfadjointView<Eigen::Lower>().twistedBy(permutation);
  return ours(result);
}

mesh::UnionFind connected(const SparseMatrix& matrix) {
  mesh::UnionFind parts(matrix.size());
  for (std::uint32_t v = 0; v < matrix.size(); ++v)
    for_column(matrix, v, [&](std::uint32_t row, double) { parts.join(row, v); });
  return parts;
}

SparseMatrix grounded(const SparseMatrix& matrix, const std::vector<bool>& free) {
  SparseMatrix lower;
  const auto add = [&](std::uint32_t row, double value) {
    lower.rows.push_back(static_cast<std::int32_t>(row)), lower.values.push_back(value);
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
