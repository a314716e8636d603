#include <doctest/doctest.h>
#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <numeric>

#include "base/error.h"
#include "deform/laplacian.h"
#include "deform/shapes.h"
#include "deform/sparse/sparse_cholesky.h"
#include "deform/sparse/sparse_kernel.h"
#include "sym3/kernel.h"

using namespace viete;
using namespace viete::test;

namespace {

using DenseMatrix = Eigen::MatrixXd;
using EigensSparse = Eigen::SparseMatrix<double>;

/// Calls visit(row, column, value) for the entries of L.
template <class Visit>
void for_entries(const SparseFactor& f, const Visit& visit) {
  for (const Supernode& s : f.supernodes) {
    const double* value = f.values.data() + s.values;
    for (std::uint32_t begin = 0; begin < s.columns; begin += column_group) {
      const auto end = std::min<std::uint32_t>(begin + column_group, s.columns);
      for (auto r = begin + 1; r < s.columns; ++r) {
        for (auto c = begin; c < std::min(r, end); ++c) visit(s.first + r, s.first + c, *value++);
      }
      for (std::uint32_t i = 0; i < s.below; ++i) {
        for (auto c = begin; c < end; ++c) visit(f.rows[s.rows + i], s.first + c, *value++);
      }
    }
    CHECK(value == f.values.data() + s.values + s.entries());
  }
}

// P^T L D L^T P.
DenseMatrix product(const SparseFactor& f) {
  const auto n = Eigen::Index(f.size());
  DenseMatrix l = DenseMatrix::Identity(n, n);
  for_entries(f, [&](std::uint32_t row, std::uint32_t column, double value) {
    REQUIRE(row > column);
    l(row, column) = value;
  });
  Eigen::VectorXd d(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    d[i] = f.pivots[std::size_t(i)];
    CHECK(f.inverse[std::size_t(i)] == 1 / d[i]);
  }
  const DenseMatrix permuted = l * d.asDiagonal() * l.transpose();
  DenseMatrix result(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j)
      result(f.order[std::size_t(i)], f.order[std::size_t(j)]) = permuted(i, j);
  }
  return result;
}

EigensSparse eigens(const SparseMatrix& matrix) {
  const auto n = int(matrix.size());
  return Eigen::Map<const EigensSparse>(n, n, int(matrix.values.size()), matrix.starts.data(),
                                        matrix.rows.data(), matrix.values.data());
}

// The lower triangle of a positive definite matrix, with about `entries_a_row` entries per row.
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

// The Laplacian of a model, with every tenth vertex fixed.
SparseMatrix firm_laplacian(const mesh::Surface& s) {
  SparseMatrix k = stiffness_matrix(s.positions, s.triangles);
  for (std::uint32_t v = 0; v < k.size(); v += 10) {
    for (auto i = k.starts[v]; i < k.starts[v + 1]; ++i) {
      if (k.rows[std::size_t(i)] == int(v)) k.values[std::size_t(i)] += 1;
    }
  }
  return k;
}

void check_product(const SparseMatrix& matrix) {
  const DenseMatrix whole = DenseMatrix(eigens(matrix)).selfadjointView<Eigen::Lower>();
  const auto neighbours = neighbours_of_unknowns(matrix);
  base::WorkerPool pool(2);
  for (const auto& kernel : sym3::kernels()) {
    const auto f = factor(matrix, neighbours, elimination_order(neighbours), pool, {}, sparse_kernel(kernel));
    CAPTURE(kernel.name);
    CHECK((product(f) - whole).cwiseAbs().maxCoeff() <= 1e-14 * whole.cwiseAbs().maxCoeff());
  }
}

double multiplications(const SparseFactor& f) {
  double sum = 0;
  for (const auto& s : f.supernodes) sum += (std::pow(s.columns + s.below, 3) - std::pow(s.below, 3)) / 6;
  return sum;
}

}  // namespace

TEST_CASE("the_factors_multiply_to_the_matrix") {
  Random random(5);
  for (const std::uint32_t n : {1u, 2u, 3u, 9u, 40u, 300u}) {
    for (const double entries : {0.0, 1.0, 3.0, 8.0}) {
      CAPTURE(n);
      CAPTURE(entries);
      check_product(random_definite(n, entries, random));
    }
  }
  for (const std::uint32_t n : {2u, 4u, 5u, 8u, 17u, 33u, 70u, 300u})
    check_product(dense_definite(n, random));
}

TEST_CASE("laplacians_are_factored_connected_or_not") {
  const mesh::Surface one = tube(15, 12, 0.7, 5);
  check_product(firm_laplacian(one));
  mesh::Surface parts = together(one, box({1, 1, 1}, {5, 0, 0}));
  parts.positions.push_back({9, 9, 9});
  SparseMatrix matrix = firm_laplacian(parts);
  matrix.values.back() += 1;  // the vertex in no triangle
  for (std::uint32_t v = 0; v < matrix.size(); ++v) {
    for (auto i = matrix.starts[v]; i < matrix.starts[v + 1]; ++i) {
      if (matrix.rows[std::size_t(i)] == int(v)) matrix.values[std::size_t(i)] += 0.25;
    }
  }
  check_product(matrix);
}

TEST_CASE("an_empty_matrix_has_an_empty_factor") {
  base::WorkerPool pool(2);
  const SparseFactor none = factor(SparseMatrix{}, pool);
  CHECK(none.size() == 0);
  CHECK(none.values.empty());
}

TEST_CASE("solutions_equal_those_of_eigen") {
  base::WorkerPool pool(2);
  Random random(6);
  for (const SparseMatrix& matrix :
       {firm_laplacian(tube(90, 61, 0.7, 5)), random_definite(2000, 2, random)}) {
    const std::size_t n = matrix.size();
    Eigen::VectorXd right(n);
    for (double& x : right) x = random(-1, 1);
    const Eigen::VectorXd theirs = Eigen::SimplicialLDLT<EigensSparse>(eigens(matrix)).solve(right);
    const auto f = factor(matrix, pool);
    base::AlignedVector<double> block(4 * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) block[4 * i + 2] = right[f.order[i]];
    sparse_kernel(sym3::kernel()).forward_four(f.view(), block.data());
    sparse_kernel(sym3::kernel()).backward_four(f.view(), block.data());
    Eigen::VectorXd ours(n);
    for (std::size_t i = 0; i < n; ++i) {
      ours[f.order[i]] = block[4 * i + 2];
      CHECK(block[4 * i] == 0);
    }
    CHECK((ours - theirs).norm() < 1e-12 * theirs.norm());
  }
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

TEST_CASE("indefinite_matrices_have_a_nonpositive_pivot") {
  base::WorkerPool pool(1);
  Random random(8);
  const auto fails = [&](SparseMatrix matrix, std::uint32_t row, double diagonal) {
    for (auto i = matrix.starts[row]; i < matrix.starts[row + 1]; ++i) {
      if (matrix.rows[std::size_t(i)] == int(row)) matrix.values[std::size_t(i)] = diagonal;
    }
    return !std::ranges::all_of(factor(matrix, pool).pivots,
                                [](double pivot) { return pivot > 0 && std::isfinite(pivot); });
  };
  for (const auto& matrix : {random_definite(100, 3, random), dense_definite(70, random)}) {
    for (const std::uint32_t row : {0u, 35u, 69u}) {
      CHECK_FALSE(fails(matrix, row, 100));
      for (const double diagonal : {0.0, -1.0, double(NAN), double(INFINITY)})
        CHECK(fails(matrix, row, diagonal));
    }
  }
}

TEST_CASE("a_factorisation_reports_progress_often") {
  base::WorkerPool pool(1);
  Random random(9);
  for (const SparseMatrix& matrix : {firm_laplacian(tube(200, 101, 0.7, 9)), dense_definite(900, random)}) {
    const auto neighbours = neighbours_of_unknowns(matrix);
    const auto order = elimination_order(neighbours);
    double last = 0, longest = 0;
    const auto watch = [&](double done) {
      CHECK(done >= last);
      longest = std::max(longest, done - std::exchange(last, done));
    };
    const auto f = factor(matrix, neighbours, order, pool, watch);
    longest = std::max(longest, 1 - last);
    CHECK(last <= 1);
    CHECK(multiplications(f) > 5e7);
    CHECK(longest * multiplications(f) < 1e7);  // a few milliseconds
  }
}

TEST_CASE("a_cancelled_factorisation_stops") {
  const SparseMatrix matrix = firm_laplacian(tube(120, 101, 0.7, 9));
  int all = 0;
  base::WorkerPool one(1), two(2);
  factor(matrix, one, [&](double) { ++all; });
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

using namespace viete::deform;

namespace {

using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;

SparseMatrix firm_stiffness(const mesh::Surface& s, double firmness, std::size_t every = 1) {
  SparseMatrix k = stiffness_matrix(s.positions, s.triangles);
  for (std::size_t v = 0; v < k.size(); v += every) {
    for (auto i = k.starts[v]; i < k.starts[v + 1]; ++i) {
      if (k.rows[i] == int(v)) k.values[i] += firmness;
    }
  }
  return k;
}

Eigen::SparseMatrix<double> as_eigen(const SparseMatrix& k) {
  const auto n = int(k.size());
  return Eigen::Map<const Eigen::SparseMatrix<double>>(n, n, int(k.values.size()), k.starts.data(),
                                                       k.rows.data(), k.values.data());
}

std::vector<Vec3> random_columns(std::size_t n) {
  test::Random random(11);
  std::vector<Vec3> rows(n);
  for (Vec3& row : rows) row = random.vector(1);
  return rows;
}

Columns as_eigen_columns(std::span<const Vec3> rows) {
  Columns columns(rows.size(), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) columns.row(i) << rows[i][0], rows[i][1], rows[i][2];
  return columns;
}

}  // namespace

TEST_CASE("three_columns_at_once_equal_single_solutions_of_eigen") {
  base::WorkerPool pool(1);
  for (const double firmness : {1.0, 1e-3}) {
    const SparseMatrix k = firm_stiffness(test::tube(40, 31, 0.7, 5), firmness, 7);
    const SparseCholesky factors(k, pool);
    const auto b = random_columns(k.size());
    std::vector<Vec3> x(k.size());
    SparseCholesky::Workspace work;
    factors.solve(b, x, work);
    const Eigen::SparseMatrix<double> matrix = as_eigen(k);
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> eigen(matrix);
    const Columns right = as_eigen_columns(b), ours = as_eigen_columns(x);
    for (int c = 0; c < 3; ++c) {
      const Eigen::VectorXd theirs = eigen.solve(right.col(c));
      CHECK((ours.col(c) - theirs).norm() < 1e-12 / firmness * theirs.norm());
    }
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
  // Two bodies, and a vertex of neither.
  mesh::Surface parts = test::together(test::box(), test::box({1, 1, 1}, {5, 0, 0}));
  parts.positions.push_back({9, 9, 9});
  const SparseMatrix k = firm_stiffness(parts, 0.25);
  const std::vector<Vec3> b(k.size(), Vec3{1, 2, 3});
  std::vector<Vec3> all(k.size());
  SparseCholesky(k, pool).solve(b, all, work);
  for (const Vec3& row : all) CHECK(norm(row - Vec3{4, 8, 12}) < 1e-13);  // K 1 = 0
}

TEST_CASE("an_indefinite_matrix_is_rejected_with_the_undetermined_row") {
  base::WorkerPool pool(1);
  mesh::Surface parts = test::together(test::box(), test::box({1, 1, 1}, {5, 0, 0}));
  SparseMatrix k = stiffness_matrix(parts.positions, parts.triangles);
  k.values[0] += 1;  // fixes the first part but not the second
  REQUIRE(k.rows[0] == 0);
  CHECK_THROWS_AS(SparseCholesky(k, pool), base::Error);
  CHECK_THROWS_AS(SparseCholesky(SparseMatrix{{0, 1}, {0}, {0}}, pool), base::Error);
  CHECK_THROWS_AS(SparseCholesky(SparseMatrix{{0, 1}, {0}, {-1}}, pool), base::Error);
  CHECK_THROWS_AS(SparseCholesky(SparseMatrix{{0, 1}, {0}, {NAN}}, pool), base::Error);
  CHECK_THROWS_AS(SparseCholesky(SparseMatrix{{0, 2, 4}, {0, 1, 0, 1}, {1, 2, 2, 1}}, pool), base::Error);
  try {
    SparseCholesky(k, pool);
    FAIL("must be refused");
  } catch (const base::Error& error) {
    const std::string place = error.place();
    CHECK(std::stoi(place.substr(place.find(' '))) >= 8);
  }
}

namespace {

// Positive definite by its diagonal; both halves.
std::vector<MatrixEntry> random_entries(std::uint32_t n, Random& random) {
  std::vector<MatrixEntry> entries;
  for (std::uint32_t i = 0; i < n; ++i) entries.push_back({i, i, random(20, 30)});
  for (std::uint32_t e = 0; e < 3 * n; ++e) {
    const auto i = static_cast<std::uint32_t>(random(0, n)), j = static_cast<std::uint32_t>(random(0, n));
    const double value = random(-1, 1);
    if (i != j) entries.push_back({i, j, value}), entries.push_back({j, i, value});
  }
  return entries;
}

}  // namespace

TEST_CASE("sixteen_systems_are_solved_at_once_on_every_instruction_set") {
  base::WorkerPool pool(1);
  Random random(3);
  for (const std::uint32_t n : {1u, 2u, 3u, 50u, 400u}) {
    const auto entries = random_entries(n, random);
    const BlockSolver solver(sparse_matrix(n, entries), pool);
    CHECK(solver.unknowns() == n);
    for (const auto& kernel : sym3::kernels()) {
      base::AlignedVector<double> x(n * solved_columns), block(n * solved_columns, 0.0);
      for (double& value : x) value = random(-1, 1);
      for (const auto& [row, column, value] : entries) {
        for (std::size_t c = 0; c < solved_columns; ++c)
          block[solver.place(row) + c] += value * x[column * solved_columns + c];
      }
      solver.solve(block, sparse_kernel(kernel));
      double worst = 0;
      for (std::uint32_t i = 0; i < n; ++i) {
        for (std::size_t c = 0; c < solved_columns; ++c)
          worst = std::max(worst, std::abs(block[solver.place(i) + c] - x[i * solved_columns + c]));
      }
      CHECK(worst < 1e-14);
    }
  }
}

TEST_CASE("only_the_lower_triangle_of_a_system_is_read") {
  base::WorkerPool pool(1);
  const BlockSolver solver(
      sparse_matrix(2, std::vector<MatrixEntry>{{0, 0, 2}, {1, 0, 1}, {1, 1, 3}, {0, 1, 77}}), pool);
  base::AlignedVector<double> block(2 * solved_columns, 0.0);
  block[solver.place(0)] = 5, block[solver.place(1)] = 10;  // (1, 3)
  solver.solve(block, sparse_kernel(sym3::kernel()));
  CHECK(block[solver.place(0)] == doctest::Approx(1));
  CHECK(block[solver.place(1)] == doctest::Approx(3));
}

TEST_CASE("systems_that_are_not_positive_definite_are_refused") {
  base::WorkerPool pool(1);
  using Entries = std::vector<MatrixEntry>;
  for (const Entries& entries : {Entries{{0, 0, 1}, {1, 1, 0}}, Entries{{0, 0, 1}, {1, 1, -1}},
                                 Entries{{0, 0, 1}, {1, 0, 2}, {1, 1, 1}}, Entries{{0, 0, NAN}, {1, 1, 1}}}) {
    CHECK_THROWS_AS(BlockSolver(sparse_matrix(2, entries), pool), base::Error);
  }
}
