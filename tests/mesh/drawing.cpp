#include "mesh/drawing.h"

#include <doctest/doctest.h>

#include <random>

using namespace viete;

TEST_CASE("spacing_of_points_is_the_root_of_the_area_per_point") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> even;
  for (const std::size_t count : {100U, 5000U, 100'000U}) {
    std::vector<mesh::Point> points;
    for (std::size_t i = 0; i < count; ++i) points.push_back({4 * even(random), 9 * even(random), 1e3});
    const double exact = std::sqrt(36.0 / static_cast<double>(count));
    CHECK(mesh::point_spacing(points) == doctest::Approx(exact).epsilon(0.15));
    for (std::size_t i = 0; i < count; i += 50) points[i] = {1e6 * even(random), 0, 0};  // lonely points
    CHECK(mesh::point_spacing(points) == doctest::Approx(exact).epsilon(0.2));
  }
  CHECK(mesh::point_spacing({}) == 0);
  CHECK(mesh::point_spacing(std::vector<mesh::Point>(1)) == 0);
  CHECK(mesh::point_spacing(std::vector<mesh::Point>(100)) == 0);
}
