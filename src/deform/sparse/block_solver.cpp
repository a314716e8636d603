#include "deform/sparse/block_solver.h"

#include <cmath>

#include "base/error.h"

namespace viete::deform {

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
