#include "deform/sparse/sparse_cholesky.h"

#include <cmath>
#include <string>

#include "base/error.h"
#include "sym3/kernel.h"

namespace viete::deform {

namespace {

// The pivots of a positive definite matrix are positive; rounding leaves those of a singular one anywhere
// near 0, so that they are compared with the diagonal that they began as.
constexpr double least_pivot = 1e-14;

[[noreturn]] void refuse_row(std::size_t row) {
  throw base::Error("row " + std::to_string(row), "the system to be solved does not determine it",
                    "hold the part of the model that it belongs to");
}

double diagonal(const SparseMatrix& matrix, std::uint32_t row) {
  double sum = 0;
  for_column(matrix, row, [&](std::uint32_t other, double value) { sum += other == row ? value : 0; });
  return sum;
}

}  // namespace

SparseCholesky::SparseCholesky(const SparseMatrix& matrix, base::WorkerPool& pool, const FactorReport& report)
    : factor_(factor(matrix, pool, report)) {
  for (std::size_t i = 0; i < size(); ++i) {
    const double pivot = factor_.pivots[i];
    const std::uint32_t row = factor_.order[i];
    if (!(pivot > least_pivot * diagonal(matrix, row) && std::isfinite(pivot))) refuse_row(row);
  }
}

void SparseCholesky::solve(std::span<const mesh::Vec3> b, std::span<mesh::Vec3> x, Workspace& work) const {
  work.resize(4 * size());
  for (std::size_t i = 0; i < size(); ++i) {
    const mesh::Vec3& from = b[factor_.order[i]];
    double* to = &work[4 * i];
    to[0] = from[0], to[1] = from[1], to[2] = from[2], to[3] = 0;
  }
  sparse_kernel(sym3::kernel()).solve_four(factor_.view(), work.data());
  for (std::size_t i = 0; i < size(); ++i) {
    const double* from = &work[4 * i];
    x[factor_.order[i]] = {from[0], from[1], from[2]};
  }
}

void refuse_system() {
  throw base::Error("", "the equations of these weights have no solution in double precision",
                    "choose other weights, or repair the model's triangles");
}

BlockSolver::BlockSolver(const SparseMatrix& matrix, base::WorkerPool& pool, const FactorReport& report)
    : factor_(factor(matrix, pool, report)), places_(inverted(factor_.order)) {
  for (const double pivot : factor_.pivots) {
    if (!(pivot > 0 && std::isfinite(pivot))) refuse_system();
  }
}

void BlockSolver::solve(std::span<double> block, const SparseKernel& kernel) const {
  kernel.solve_columns(factor_.view(), block.data());
}

}  // namespace viete::deform
