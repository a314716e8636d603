#include "deform/sparse/sparse_cholesky.h"

#include <doctest/doctest.h>

#include "base/error.h"
#include "deform/shapes.h"
#include "sym3/kernel.h"
#include "deform/sparse/sparse_kernel.h"

using namespace viete;
using namespace viete::test;

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
