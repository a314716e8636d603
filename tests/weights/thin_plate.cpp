#include "weights/thin_plate.h"

#include <doctest/doctest.h>

#include <Eigen/Dense>

#include "support/caged_shapes.h"

using namespace viete;
using namespace viete::test;

namespace {

Eigen::MatrixXd dense(const SparseMatrix& m) {
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(Eigen::Index(m.size()), Eigen::Index(m.size()));
  for (std::uint32_t j = 0; j < m.size(); ++j)
    for_column(m, j, [&](std::uint32_t i, double value) { full(i, j) = value; });
  return full;
}

// Returns the largest difference of the plate's shapes from expected_shapes().
double worst_difference(const ThinPlate& plate, const Eigen::MatrixXd& expected) {
  const auto n = std::size_t(expected.rows()), loads = std::size_t(expected.cols());
  double worst = 0;
  for (std::size_t begin = 0; begin < loads; begin += solved_columns) {
    const std::size_t end = std::min(begin + solved_columns, loads);
    base::AlignedVector<double> block(n * solved_columns, 0.0);
    plate.solve(begin, end, block);
    for (std::size_t v = 0; v < n; ++v)
      for (std::size_t k = begin; k < end; ++k)
        worst = std::max(worst, std::abs(block[plate.solver().row_of(v) + k - begin] -
                                         expected(Eigen::Index(v), Eigen::Index(k))));
  }
  return worst;
}

// Computes the minimum with one dense system. Includes only the vertices of parts with springs.
Eigen::MatrixXd expected_shapes(const IntrinsicLaplacian& laplacian, const HeldParts& parts,
                                const std::vector<bool>& has_spring, const std::vector<double>& strengths,
                                const std::vector<ThinPlate::Load>& loads) {
  const Eigen::MatrixXd l = dense(laplacian.stiffness);
  const auto n = l.rows();
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n, n),
                  right = Eigen::MatrixXd::Zero(n, Eigen::Index(loads.size()));
  for (Eigen::Index v = 0; v < n; ++v)
    if (laplacian.masses[v] > 0) system += l.col(v) * l.row(v) / laplacian.masses[v];
  for (Eigen::Index v = 0; v < n; ++v) {
    if (has_spring[v]) system(v, v) += strengths[std::size_t(v)];
    if (parts.holds(std::uint32_t(v))) continue;
    system.row(v).setZero();
    system.col(v).setZero();
    system(v, v) = 1;
  }
  for (std::size_t k = 0; k < loads.size(); ++k)
    for (const auto& [v, value] : loads[k]) right(v, Eigen::Index(k)) = strengths[v] * value;
  return system.ldlt().solve(right);
}

}  // namespace

TEST_CASE("parts_are_held_by_springs_and_grounded_at_the_first_one") {
  const auto model = together(together(box(), box({1, 1, 1}, {5, 0, 0})), box({1, 1, 1}, {9, 0, 0}));
  std::vector<bool> has_spring(model.positions.size(), false);
  has_spring[19] = has_spring[17] = has_spring[3] = true;
  const auto parts = held_parts(intrinsic_laplacian(model).stiffness, has_spring);
  CHECK(parts.grounds == std::vector<std::uint32_t>{3, 17});
  for (std::uint32_t v = 0; v < 24; ++v) {
    CHECK(parts.holds(v) == (v / 8 != 1));
    if (parts.holds(v)) CHECK(parts.of_vertex[v] == v / 16);
  }
}

TEST_CASE("plates_take_the_shape_of_least_bending_and_springs_part_by_part") {
  // Four parts: two with several springs, one with one spring, and one without. A vertex has no triangle.
  auto model =
      together(together(tube(8, 9, 0.5, 2), tube(5, 6, 0.2, 1)), together(box(), box({1, 1, 1}, {5, 0, 0})));
  model.positions.push_back({7, 7, 7});
  const auto laplacian = intrinsic_laplacian(model);
  const std::size_t n = model.positions.size();
  std::vector<bool> has_spring(n, false);
  std::vector<ThinPlate::Load> loads;
  for (const std::uint32_t v : {0u, 5u, 20u, 44u, 60u, 73u, 75u, 80u, 95u, 106u}) {
    has_spring[v] = true;
    loads.push_back({{v, 1.0 / (1 + v)}});
  }
  for (std::uint32_t again = 0; again < 12; ++again) loads.push_back(loads[again % 10]);
  loads.push_back({});
  loads.push_back({{0, 0.5}, {80, 0.25}, {95, -1}});  // in two parts; vertex 0 is a ground, see HeldParts
  base::WorkerPool pool(2);
  const auto parts = held_parts(laplacian.stiffness, has_spring);
  REQUIRE(parts.grounds.size() == 3);
  for (const double spring : {0.1, 10.0, 1e4}) {
    std::vector<double> strengths;
    for (std::size_t v = 0; v < n; ++v) strengths.push_back(spring / static_cast<double>(1 + v % 3));
    const ThinPlate plate(laplacian, parts, has_spring, strengths, loads, pool);
    const auto expected = expected_shapes(laplacian, parts, has_spring, strengths, loads);
    CHECK(plate.factors_whole() == (spring > 1));
    CHECK(worst_difference(plate, expected) < 1e-10);
  }
}

TEST_CASE("plates_with_few_springs_or_masses_near_0_factor_only_the_laplacian") {
  base::WorkerPool pool(2);
  for (const double width : {1.0, 1e-7}) {
    const auto model = tube(32, 9, 0.5, 2);
    auto laplacian = intrinsic_laplacian(model);
    const std::size_t n = model.positions.size();
    laplacian.masses[7] *= width;
    std::vector<bool> has_spring(n, width < 1);
    std::vector<ThinPlate::Load> loads;
    for (const std::uint32_t v : {3u, 77u, 200u, 280u}) {
      has_spring[v] = true;
      loads.push_back({{v, 1}});
    }
    const auto parts = held_parts(laplacian.stiffness, has_spring);
    const std::vector<double> strengths(n, 10);
    const ThinPlate plate(laplacian, parts, has_spring, strengths, loads, pool);
    CHECK_FALSE(plate.factors_whole());
    CHECK(worst_difference(plate, expected_shapes(laplacian, parts, has_spring, strengths, loads)) < 1e-6);
  }
}
