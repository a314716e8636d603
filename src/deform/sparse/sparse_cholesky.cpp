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

void put(const mesh::Vec3& from, double* to) {
  to[0] = from[0], to[1] = from[1], to[2] = from[2], to[3] = 0;
}
mesh::Vec3 vec(const double* from) {
  return {from[0], from[1], from[2]};
}

}  // namespace

SparseCholesky::SparseCholesky(const SparseMatrix& matrix, base::WorkerPool& pool, const FactorReport& report)
    : factor_(factor(matrix, pool, report)), places_(inverted(factor_.order)), nodes_(size()) {
  for (std::uint32_t s = 0; s < factor_.supernodes.size(); ++s) {
    const Supernode& node = factor_.supernodes[s];
    for (auto i = node.first; i < node.first + node.columns; ++i) nodes_[factor_.order[i]] = s;
  }
  for (std::size_t i = 0; i < size(); ++i) {
    const double pivot = factor_.pivots[i];
    const std::uint32_t row = factor_.order[i];
    if (!(pivot > least_pivot * diagonal(matrix, row) && std::isfinite(pivot))) refuse_row(row);
  }
}

void SparseCholesky::read(std::span<const mesh::Vec3> b, Workspace& work) const {
  work.rows.resize(4 * size());
  for (std::size_t i = 0; i < size(); ++i) put(b[factor_.order[i]], &work.rows[4 * i]);
}

void SparseCholesky::write(const Workspace& work, std::span<mesh::Vec3> x) const {
  for (std::size_t i = 0; i < size(); ++i) x[factor_.order[i]] = vec(&work.rows[4 * i]);
}

void SparseCholesky::solve(std::span<const mesh::Vec3> b, std::span<mesh::Vec3> x, Workspace& work) const {
  const SparseKernel& kernel = sparse_kernel(sym3::kernel());
  read(b, work);
  kernel.forward_four(factor_.view(), work.rows.data());
  kernel.backward_four(factor_.view(), work.rows.data());
  write(work, x);
}

// The supernodes of some unknowns and all above these.
void SparseCholesky::find_part(std::span<const std::uint32_t> some, Workspace& work) const {
  work.seen.assign(factor_.supernodes.size(), 0), work.nodes.clear();
  for (const auto u : some)
    for (auto s = nodes_[u]; s != no_parent && !work.seen[s]; s = factor_.parents[s]) work.seen[s] = 1;
  for (std::size_t s = 0; s < work.seen.size(); ++s)
    if (work.seen[s]) work.nodes.push_back(factor_.supernodes[s]);
}

// L^-1 (b + c) = L^-1 b + L^-1 c, and the last of these is 0 but in the part.
void SparseCholesky::solve_corrected(std::span<mesh::Vec3> b, std::span<mesh::Vec3> x,
                                     std::span<const std::uint32_t> some,
                                     const std::function<void()>& correct, Workspace& work) const {
  const SparseKernel& kernel = sparse_kernel(sym3::kernel());
  read(b, work);
  kernel.forward_four(factor_.view(), work.rows.data());
  find_part(some, work);
  work.part.resize(4 * size());
  TriangularFactor part = factor_.view();
  part.supernodes = work.nodes.data(), part.count = work.nodes.size();
  const auto for_part = [&](const auto& visit) {
    for (const Supernode& node : work.nodes)
      for (std::size_t i = 4 * node.first; i < 4 * (node.first + node.columns); ++i) visit(i);
  };
  for_part([&](std::size_t i) { work.part[i] = work.rows[i]; });
  kernel.backward_four(part, work.part.data());
  for (const auto u : some) x[u] = vec(&work.part[4 * places_[u]]), b[u] = {0, 0, 0};
  correct();
  for_part([&](std::size_t i) { work.part[i] = 0; });
  for (const auto u : some) put(b[u], &work.part[4 * places_[u]]);
  kernel.forward_four(part, work.part.data());
  for_part([&](std::size_t i) { work.rows[i] += work.part[i]; });
  kernel.backward_four(factor_.view(), work.rows.data());
  write(work, x);
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
