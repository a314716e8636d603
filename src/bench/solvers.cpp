#include "bench/solvers.h"

#include <Eigen/SparseCholesky>
#include <cstdio>
#include <string>

#include "base/quantity.h"
#include "base/worker_pool.h"
#include "bench/timing/rounds.h"
#include "deform/sparse/sparse_cholesky.h"

namespace viete::bench {

namespace {

constexpr const char* steps[] = {"ordered", "factored", "three columns", "sixteen columns"};

class SolverRuns {
public:
  explicit SolverRuns(const deform::SparseMatrix& matrix)
      : matrix_(matrix),
        neighbours_(deform::neighbours_of_unknowns(matrix)),
        order_(deform::elimination_order(neighbours_)),
        cholesky_(matrix, pool_),
        blocks_(matrix, pool_),
        three_(size(), mesh::Vec3{1, 2, 3}),
        eigens_(Eigen::Map<const Eigen::SparseMatrix<double>>(int(size()), int(size()), matrix.starts.back(),
                                                              matrix.starts.data(), matrix.rows.data(),
                                                              matrix.values.data())),
        sixteen_(size() * deform::solved_columns, 1.0),
        right_(Eigen::MatrixXd::Ones(Eigen::Index(size()), deform::solved_columns)) {}

  std::vector<BenchResult> run(std::size_t rounds) {
    std::vector<RoundCase> cases;
    const auto add = [&](const char* step, auto ours, auto theirs) {
      cases.push_back({step + std::string(", ours"), size(), [=](std::size_t) { ours(); }});
      cases.push_back({step + std::string(", Eigen"), size(), [=](std::size_t) { theirs(); }});
    };
    add(
        steps[0], [this] { deform::elimination_order(deform::neighbours_of_unknowns(matrix_)); },
        [this] { theirs_.analyzePattern(eigens_); });
    add(
        steps[1], [this] { deform::factor(matrix_, neighbours_, order_, pool_); },
        [this] { theirs_.factorize(eigens_); });
    add(
        steps[2], [this] { cholesky_.solve(three_, solved_, work_); },
        [this] { solution_ = theirs_.solve(right_.leftCols(3)); });
    add(
        steps[3], [this] { blocks_.solve(sixteen_, deform::sparse_kernel(sym3::kernel())); },
        [this] { solution_ = theirs_.solve(right_); });
    solved_.resize(size());
    base::Progress progress;
    return measure_rounds(cases, rounds, progress);
  }

  std::size_t size() const { return matrix_.size(); }
  std::size_t ours() const { return cholesky_.entries(); }
  /// Without the diagonal, as ours.
  std::size_t eigens_entries() const { return std::size_t(theirs_.matrixL().nestedExpression().nonZeros()); }

private:
  const deform::SparseMatrix& matrix_;
  base::WorkerPool pool_{1};
  mesh::Adjacency neighbours_;
  std::vector<std::uint32_t> order_;
  deform::SparseCholesky cholesky_;
  deform::BlockSolver blocks_;
  std::vector<mesh::Vec3> three_, solved_;
  deform::SparseCholesky::Workspace work_;
  Eigen::SparseMatrix<double> eigens_;
  base::AlignedVector<double> sixteen_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> theirs_;
  Eigen::MatrixXd right_, solution_;
};

}  // namespace

std::vector<BenchResult> compare_solvers(const deform::SparseMatrix& matrix, std::size_t rounds) {
  SolverRuns runs(matrix);
  const auto results = runs.run(rounds);
  std::printf("  solver, %s unknowns %17s %12s\n", base::with_thousands(runs.size()).c_str(), "ours",
              "Eigen's");
  for (const std::string step : steps) {
    const double ours = time_of(results, step + ", ours"), theirs = time_of(results, step + ", Eigen");
    const double ms = static_cast<double>(runs.size()) * 1e-6;
    std::printf("  %-24s %9.2f ms %9.2f ms %6.1f times\n", step.c_str(), ours * ms, theirs * ms,
                theirs / ours);
  }
  std::printf("  %-24s %12s %12s\n", "entries of the factor", base::with_thousands(runs.ours()).c_str(),
              base::with_thousands(runs.eigens_entries()).c_str());
  return results;
}

}  // namespace viete::bench
