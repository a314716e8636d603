#include "deform/block_solver.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "base/error.h"

namespace viete::deform {

void refuse_system() {
  throw base::Error("", "the equations of these weights have no solution in double precision",
                    "choose other weights, or repair the model's triangles");
}

BlockSolver::BlockSolver(const SparseMatrix& matrix) {
  using Sparse = Eigen::SparseMatrix<double>;
  const auto n = static_cast<Eigen::Index>(matrix.size());
  const Eigen::Map<const Sparse> view(n, n, static_cast<Eigen::Index>(matrix.values.size()),
                                      matrix.starts.data(), matrix.rows.data(), matrix.values.data());
  const Eigen::SimplicialLDLT<Sparse> factored(view);
  const auto& diagonal = factored.vectorD();
  if (factored.info() != Eigen::Success || !(diagonal.minCoeff() > 0)) {
    refuse_system();
  }
  const auto& l = factored.matrixL().nestedExpression();
  starts_.assign(l.outerIndexPtr(), l.outerIndexPtr() + n + 1);
  rows_.assign(l.innerIndexPtr(), l.innerIndexPtr() + starts_.back());
  values_.assign(l.valuePtr(), l.valuePtr() + starts_.back());
  const auto& places = factored.permutationP().indices();
  places_.assign(places.data(), places.data() + n);
  for (Eigen::Index i = 0; i < n; ++i) inverse_diagonal_.push_back(1 / diagonal[i]);
}

void BlockSolver::solve(std::span<double> block, const BindKernel& kernel) const {
  kernel.solve_columns({starts_.data(), rows_.data(), values_.data(), inverse_diagonal_.data(), unknowns()},
                       block.data());
}

}  // namespace viete::deform
