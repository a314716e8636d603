#include "deform/factoring.h"

#include <doctest/doctest.h>

#include "deform/shapes.h"
#include "deform/bind_kernel.h"

using namespace viete::test;

TEST_CASE("rows_of_low_rank_are_factors_of_a_few_of_them_on_every_instruction_set") {
  // 64 rows of 40 columns, of rank 5 and some noise.
  constexpr std::size_t tiles = 4, columns = 40, lanes = 16;
  Random random(23);
  std::vector<std::vector<double>> left(64, std::vector<double>(5)), right(5, std::vector<double>(columns));
  for (auto& row : left)
    for (double& x : row) x = random(-1, 1);
  for (auto& row : right)
    for (double& x : row) x = random(-1, 1);
  viete::base::AlignedVector<float> rows(tiles * lanes * columns);
  const auto entry = [&](std::size_t s, std::size_t j) {
    return rows[s / lanes * lanes * columns + j * lanes + s % lanes];
  };
  for (std::size_t s = 0; s < 64; ++s) {
    for (std::size_t j = 0; j < columns; ++j) {
      double sum = random(-1e-6, 1e-6);
      for (int t = 0; t < 5; ++t) sum += left[s][t] * right[t][j];
      rows[s / lanes * lanes * columns + j * lanes + s % lanes] = static_cast<float>(sum);
    }
  }
  for (const auto& kernel : viete::sym3::kernels()) {
    CAPTURE(kernel.name);
    viete::base::AlignedVector<float> work = rows;
    const Factors f = factor_rows({work.data(), tiles, columns}, 64, 1e-4, 20, bind_kernel(kernel));
    REQUIRE(f.pivots.size() == 5);
    double worst = 0;
    for (std::size_t s = 0; s < 64; ++s) {
      double squared = 0;
      for (std::size_t j = 0; j < columns; ++j) {
        double sum = 0;
        for (std::size_t t = 0; t < 5; ++t)
          sum += f.factors[s / lanes * lanes * 5 + t * lanes + s % lanes] * entry(f.pivots[t], j);
        squared += (sum - entry(s, j)) * (sum - entry(s, j));
      }
      worst = std::max(worst, std::sqrt(squared));
    }
    CHECK(worst < 1e-4);
    work = rows;
    CHECK(factor_rows({work.data(), tiles, columns}, 64, 1e-4, 4, bind_kernel(kernel)).pivots.empty());
  }
}
