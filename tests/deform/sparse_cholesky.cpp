#include "deform/sparse/sparse_cholesky.h"

#include <doctest/doctest.h>

#include <Eigen/SparseCholesky>

#include "base/error.h"
#include "deform/shapes.h"
#include "deform/laplacian.h"

using namespace viete;
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

TEST_CASE("three_columns_at_once_are_eigens_one_by_one") {
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

TEST_CASE("systems_of_no_row_of_one_and_of_parts_are_solved") {
  base::WorkerPool pool(1);
  SparseCholesky::Workspace work;
  SparseCholesky(SparseMatrix{}, pool).solve({}, {}, work);
  const SparseMatrix one{{0, 1}, {0}, {4}};
  std::vector<Vec3> x = {{8, -4, 2}};
  SparseCholesky(one, pool).solve(x, x, work);
  CHECK(x[0] == Vec3{2, -1, 0.5});
  // Two bodies, and a vertex of none.
  mesh::Surface parts = test::together(test::box(), test::box({1, 1, 1}, {5, 0, 0}));
  parts.positions.push_back({9, 9, 9});
  const SparseMatrix k = firm_stiffness(parts, 0.25);
  const std::vector<Vec3> b(k.size(), Vec3{1, 2, 3});
  std::vector<Vec3> all(k.size());
  SparseCholesky(k, pool).solve(b, all, work);
  for (const Vec3& row : all) CHECK(norm(row - Vec3{4, 8, 12}) < 1e-13);  // K 1 = 0
}

TEST_CASE("a_matrix_that_is_not_positive_definite_is_refused_by_the_row_that_is_not_determined") {
  base::WorkerPool pool(1);
  mesh::Surface parts = test::together(test::box(), test::box({1, 1, 1}, {5, 0, 0}));
  SparseMatrix k = stiffness_matrix(parts.positions, parts.triangles);
  k.values[0] += 1;  // the first part is held, the second is not
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
