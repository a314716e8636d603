#include <doctest/doctest.h>
#include <Eigen/Cholesky>
#include <Eigen/SparseCore>

#include "sparse/sparse_cholesky.h"
#include "support/caged_shapes.h"
#include "weights/laplacian.h"

using namespace viete;
using namespace viete::test;

namespace {

using DenseMatrix = Eigen::MatrixXd;
using EigensSparse = Eigen::SparseMatrix<double>;

EigensSparse eigens(const SparseMatrix& matrix) {
  const auto n = int(matrix.size());
  return Eigen::Map<const EigensSparse>(n, n, int(matrix.values.size()), matrix.starts.data(),
                                        matrix.rows.data(), matrix.values.data());
}

// Returns the lower triangle of a positive definite matrix. Each row has about `entries_a_row` entries.
SparseMatrix random_definite(std::uint32_t n, double entries_a_row, Random& random) {
  std::vector<MatrixEntry> entries;
  for (std::uint32_t i = 0; i < n; ++i) entries.push_back({i, i, 4 * entries_a_row + random(1, 2)});
  for (std::uint32_t e = 0; e < entries_a_row * n / 2; ++e) {
    const auto i = std::uint32_t(random(0, n)), j = std::uint32_t(random(0, n));
    if (i != j) entries.push_back({std::max(i, j), std::min(i, j), random(-1, 1)});
  }
  return sparse_matrix(n, entries);
}

SparseMatrix dense_definite(std::uint32_t n, Random& random) {
  std::vector<MatrixEntry> entries;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < i; ++j) entries.push_back({i, j, random(-1, 1)});
    entries.push_back({i, i, double(n)});
  }
  return sparse_matrix(n, entries);
}

// Returns the Laplacian of a model in which some vertices are fixed.
SparseMatrix firm_laplacian(const mesh::Surface& s, double firmness = 1, std::uint32_t every = 10) {
  SparseMatrix k = stiffness_matrix(s.positions, s.triangles);
  for (std::uint32_t v = 0; v < k.size(); v += every)
    for (auto i = k.starts[v]; i < k.starts[v + 1]; ++i)
      if (k.rows[std::size_t(i)] == int(v)) k.values[std::size_t(i)] += firmness;
  return k;
}

// Returns two bodies, and a vertex that belongs to no body.
mesh::Surface two_bodies() {
  mesh::Surface parts = together(tube(15, 12, 0.7, 5), box({1, 1, 1}, {5, 0, 0}));
  parts.positions.push_back({9, 9, 9});
  return parts;
}

DenseMatrix whole_of(const SparseMatrix& matrix) {
  return DenseMatrix(eigens(matrix)).selfadjointView<Eigen::Lower>();
}

// Solves for the second of four columns. The other columns are 0.
void check_solution(const SparseMatrix& matrix) {
  const DenseMatrix whole = whole_of(matrix);
  const std::size_t n = matrix.size();
  const Eigen::VectorXd x = Eigen::VectorXd::Random(Eigen::Index(n)), b = whole * x;
  const auto neighbours = neighbours_of_unknowns(matrix);
  base::WorkerPool pool(2);
  for (const auto& kernel : sym3::kernels()) {
    CAPTURE(kernel.name);
    const SparseKernel& vector_code = sparse_kernel(kernel);
    const auto f = factor(matrix, neighbours, elimination_order(neighbours), pool, {}, vector_code);
    base::AlignedVector<double> block(4 * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) block[4 * i + 1] = b[f.order[i]];
    vector_code.forward_four(f.view(), block.data());
    vector_code.backward_four(f.view(), block.data());
    Eigen::VectorXd found(b.size());
    for (std::size_t i = 0; i < n; ++i) {
      found[f.order[i]] = block[4 * i + 1];
      CHECK(block[4 * i] == 0);
    }
    CHECK((whole * found - b).cwiseAbs().maxCoeff() <= 5e-14 * whole.cwiseAbs().maxCoeff());
  }
}

using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;

Columns as_eigen_columns(std::span<const Vec3> rows) {
  Columns columns(rows.size(), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) columns.row(i) << rows[i][0], rows[i][1], rows[i][2];
  return columns;
}

}  // namespace

TEST_CASE("systems_are_solved_by_their_factors_on_every_instruction_set") {
  Random random(5);
  for (const std::uint32_t n : {1u, 2u, 3u, 9u, 40u, 300u})
    for (const double entries : {0.0, 1.0, 3.0, 8.0}) {
      CAPTURE(n);
      CAPTURE(entries);
      check_solution(random_definite(n, entries, random));
    }
  for (const std::uint32_t n : {2u, 4u, 5u, 8u, 17u, 33u, 70u, 300u})
    check_solution(dense_definite(n, random));
  check_solution(firm_laplacian(tube(15, 12, 0.7, 5)));
  check_solution(firm_laplacian(two_bodies(), 0.25, 1));
}

TEST_CASE("factors_are_the_same_for_any_number_of_threads") {
  base::WorkerPool one(1), two(2), three(3);
  Random random(7);
  for (const SparseMatrix& matrix : {firm_laplacian(tube(90, 61, 0.7, 5)), dense_definite(1000, random)}) {
    const auto first = factor(matrix, one);
    for (auto* pool : {&two, &three}) {
      const auto other = factor(matrix, *pool);
      CHECK(other.order == first.order);
      CHECK(other.rows == first.rows);
      CHECK(other.values == first.values);
      CHECK(other.pivots == first.pivots);
    }
  }
}

TEST_CASE("a_factorisation_reports_progress_and_stops_when_cancelled") {
  const SparseMatrix matrix = firm_laplacian(tube(120, 101, 0.7, 9));
  int all = 0;
  base::WorkerPool one(1), two(2);
  factor(matrix, one, [&, last = 0.0](double done) mutable {
    CHECK(done >= std::exchange(last, done));
    ++all;
  });
  REQUIRE(all > 20);
  for (const int last : {1, 2, all / 2, all}) {
    base::Progress progress;
    const FactorReport tell = told(&progress, 0.25, 0.75);
    int calls = 0;
    const auto cancelled_at_last = [&](double done) {
      if (++calls == last) progress.cancel();
      tell(done);
    };
    CHECK_THROWS_AS(factor(matrix, one, cancelled_at_last), base::Cancelled);
    CHECK(calls == last);
    CHECK(progress.done() >= 0.25);
    CHECK(progress.done() <= 0.75);
  }
  base::Progress progress;
  progress.cancel();
  CHECK_THROWS_AS(factor(matrix, two, told(&progress, 0, 1)), base::Cancelled);
}

TEST_CASE("three_columns_are_solved_at_once_and_in_place") {
  base::WorkerPool pool(1);
  for (const double firmness : {1.0, 1e-3}) {
    const SparseMatrix k = firm_laplacian(tube(40, 31, 0.7, 5), firmness, 7);
    const SparseCholesky factors(k, pool);
    const auto b = Random(11).vectors(k.size(), 1);
    std::vector<Vec3> x(k.size());
    SparseCholesky::Workspace work;
    factors.solve(b, x, work);
    const EigensSparse matrix = eigens(k);
    const Columns right = as_eigen_columns(b), ours = as_eigen_columns(x);
    CHECK((matrix * ours - right).norm() < 1e-12 / firmness * right.norm());
    std::vector<Vec3> in_place = b;
    factors.solve(in_place, in_place, work);
    CHECK(in_place == x);
  }
}

TEST_CASE("empty_single_row_and_disconnected_systems_are_solved") {
  base::WorkerPool pool(1);
  SparseCholesky::Workspace work;
  SparseCholesky(SparseMatrix{}, pool).solve({}, {}, work);
  const SparseMatrix one{{0, 1}, {0}, {4}};
  std::vector<Vec3> x = {{8, -4, 2}};
  SparseCholesky(one, pool).solve(x, x, work);
  CHECK(x[0] == Vec3{2, -1, 0.5});
  const SparseMatrix k = firm_laplacian(two_bodies(), 0.25, 1);
  const std::vector<Vec3> b(k.size(), Vec3{1, 2, 3});
  std::vector<Vec3> all(k.size());
  SparseCholesky(k, pool).solve(b, all, work);
  for (const Vec3& row : all) CHECK(norm(row - Vec3{4, 8, 12}) < 1e-13);  // K * 1 = 0
}

TEST_CASE("an_indefinite_matrix_is_rejected_with_the_undetermined_row") {
  base::WorkerPool pool(1);
  const mesh::Surface parts = together(box(), box({1, 1, 1}, {5, 0, 0}));
  SparseMatrix k = stiffness_matrix(parts.positions, parts.triangles);
  k.values[0] += 1;  // fixes the first part but not the second
  REQUIRE(k.rows[0] == 0);
  CHECK_THROWS_AS(SparseCholesky(k, pool), base::Error);
  for (const SparseMatrix& bad :
       {SparseMatrix{{0, 1}, {0}, {0}}, SparseMatrix{{0, 1}, {0}, {-1}}, SparseMatrix{{0, 1}, {0}, {NAN}},
        SparseMatrix{{0, 2, 4}, {0, 1, 0, 1}, {1, 2, 2, 1}}}) {
    CHECK_THROWS_AS(SparseCholesky(bad, pool), base::Error);
    CHECK_THROWS_AS(BlockSolver(bad, pool), base::Error);
  }
  try {
    SparseCholesky(k, pool);
    FAIL("must be refused");
  } catch (const base::Error& error) {
    const std::string place = error.place();
    CHECK(std::stoi(place.substr(place.find(' '))) >= 8);
  }
}

TEST_CASE("sixteen_systems_are_solved_at_once_on_every_instruction_set") {
  base::WorkerPool pool(1);
  Random random(3);
  for (const std::uint32_t n : {1u, 2u, 3u, 50u, 400u}) {
    const SparseMatrix matrix = random_definite(n, 6, random);
    const BlockSolver solver(matrix, pool);
    CHECK(solver.unknowns() == n);
    const DenseMatrix x = DenseMatrix::Random(n, Eigen::Index(solved_columns)), b = whole_of(matrix) * x;
    for (const auto& kernel : sym3::kernels()) {
      base::AlignedVector<double> block(n * solved_columns);
      for (std::uint32_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < solved_columns; ++c) block[solver.row_of(i) + c] = b(i, Eigen::Index(c));
      solver.solve(block, sparse_kernel(kernel));
      double worst = 0;
      for (std::uint32_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < solved_columns; ++c)
          worst = std::max(worst, std::abs(block[solver.row_of(i) + c] - x(i, Eigen::Index(c))));
      CHECK(worst < 1e-14);
    }
  }
}

TEST_CASE("only_the_lower_triangle_of_a_system_is_read") {
  base::WorkerPool pool(1);
  const BlockSolver solver(
      sparse_matrix(2, std::vector<MatrixEntry>{{0, 0, 2}, {1, 0, 1}, {1, 1, 3}, {0, 1, 77}}), pool);
  base::AlignedVector<double> block(2 * solved_columns, 0.0);
  block[solver.row_of(0)] = 5;
  block[solver.row_of(1)] = 10;  // for the solution (1, 3)
  solver.solve(block, sparse_kernel(sym3::kernel()));
  CHECK(block[solver.row_of(0)] == doctest::Approx(1));
  CHECK(block[solver.row_of(1)] == doctest::Approx(3));
}
