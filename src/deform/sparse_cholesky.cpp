#include "deform/sparse_cholesky.h"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <string>

#include "base/error.h"

namespace viete::deform {

namespace {

using EigenSparse = Eigen::SparseMatrix<double>;

// The pivots of a positive definite matrix are positive; rounding leaves those of a singular one anywhere
// near 0, so that they are compared with the diagonal that they began as.
constexpr double least_pivot = 1e-14;

[[noreturn]] void refuse_row(std::size_t row) {
  throw base::Error("row " + std::to_string(row), "the system to be solved does not determine it",
                    "hold the part of the model that it belongs to");
}

// a - w b.
SparseCholesky::Row less(const SparseCholesky::Row& a, double w, const SparseCholesky::Row& b) {
  SparseCholesky::Row row;
  for (int c = 0; c < 4; ++c) row.x[c] = a.x[c] - w * b.x[c];
  return row;
}

}  // namespace

SparseCholesky::SparseCholesky(const SparseMatrix& matrix) {
  const auto n = static_cast<int>(matrix.size());
  const Eigen::Map<const EigenSparse> view(n, n, static_cast<int>(matrix.values.size()), matrix.starts.data(),
                                           matrix.rows.data(), matrix.values.data());
  Eigen::SimplicialLDLT<EigenSparse, Eigen::Lower, Eigen::AMDOrdering<int>> factors;
  factors.compute(view);
  const auto& order = factors.permutationPinv().indices();
  rows_of_.assign(order.data(), order.data() + n);
  const auto& pivots = factors.vectorD();
  inverse_pivots_.resize(matrix.size());
  for (std::size_t i = 0; i < size(); ++i) {
    const double pivot = pivots[static_cast<Eigen::Index>(i)];
    const auto row = static_cast<int>(rows_of_[i]);
    if (!(pivot > least_pivot * view.coeff(row, row) && std::isfinite(pivot))) refuse_row(rows_of_[i]);
    inverse_pivots_[i] = 1 / pivot;
  }
  if (factors.info() != Eigen::Success) refuse_row(0);
  const EigenSparse& lower = factors.matrixL().nestedExpression();
  starts_.assign(lower.outerIndexPtr(), lower.outerIndexPtr() + n + 1);
  below_.assign(lower.innerIndexPtr(), lower.innerIndexPtr() + starts_.back());
  values_.assign(lower.valuePtr(), lower.valuePtr() + starts_.back());
}

void SparseCholesky::solve(std::span<const Vec3> b, std::span<Vec3> x, Workspace& work) const {
  work.resize(size());
  for (std::size_t i = 0; i < size(); ++i) {
    const Vec3& from = b[rows_of_[i]];
    work[i] = {{from[0], from[1], from[2], 0}};
  }
  solve_lower(work.data());
  solve_upper(work.data());
  for (std::size_t i = 0; i < size(); ++i) {
    const Row& from = work[i];
    x[rows_of_[i]] = {from.x[0], from.x[1], from.x[2]};
  }
}

void SparseCholesky::solve_lower(Row* rows) const {
  for (std::size_t j = 0; j < size(); ++j) {
    const Row known = rows[j];
    for (std::uint32_t i = starts_[j]; i < starts_[j + 1]; ++i) {
      Row& row = rows[below_[i]];
      row = less(row, values_[i], known);
    }
  }
}

// From the last entry to the first, so that memory is read in one direction and fetched ahead; every other
// one goes into a sum of its own, so that one does not wait for the other.
void SparseCholesky::solve_upper(Row* rows) const {
  std::uint32_t i = starts_.back();
  for (std::size_t j = size(); j-- > 0;) {
    Row sum = rows[j], other{};
    for (double& x : sum.x) x *= inverse_pivots_[j];
    for (; i > starts_[j] + 1; i -= 2) {
      sum = less(sum, values_[i - 1], rows[below_[i - 1]]);
      other = less(other, values_[i - 2], rows[below_[i - 2]]);
    }
    if (i > starts_[j]) --i, sum = less(sum, values_[i], rows[below_[i]]);
    rows[j] = less(sum, -1, other);
  }
}

}  // namespace viete::deform
