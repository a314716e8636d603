#include "mesh/distance.h"

#include <doctest/doctest.h>

#include <random>

#include "mesh/shapes.h"

using namespace viete;
using namespace viete::mesh;

namespace {

// The nearest of many points spread over the triangle: never nearer than the truth.
double sampled(const Point& p, const Point& a, const Point& b, const Point& c) {
  double least = 1e300;
  constexpr int n = 200;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j) {
      const double u = i / double{n}, v = j / double{n}, w = 1 - u - v;
      double d = 0;
      for (int k = 0; k < 3; ++k) d += std::pow(u * a[k] + v * b[k] + w * c[k] - p[k], 2);
      least = std::min(least, d);
    }
  }
  return least;
}

}  // namespace

TEST_CASE("distance_agrees_with_the_nearest_of_many_sampled_points") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto point = [&] { return Point{uniform(random), uniform(random), uniform(random)}; };
  for (int i = 0; i < 100; ++i) {
    const Point p = point(), a = point(), b = point(), c = point();
    const double exact = std::sqrt(squared_distance(p, a, b, c)), nearest = std::sqrt(sampled(p, a, b, c));
    CHECK(exact <= nearest + 1e-14);
    CHECK(exact >= nearest - 0.02);
  }
}

TEST_CASE("distance_in_each_region_of_a_triangle") {
  const Point a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0};
  CHECK(squared_distance({1, 1, 3}, a, b, c) == doctest::Approx(9));
  CHECK(squared_distance({1, 1, -3}, a, b, c) == doctest::Approx(9));
  CHECK(squared_distance({1, 1, 0}, a, b, c) == 0);
  CHECK(squared_distance({2, -3, 0}, a, b, c) == doctest::Approx(9));
  CHECK(squared_distance({-3, -4, 0}, a, b, c) == doctest::Approx(25));
  CHECK(squared_distance({4, 4, 1}, a, b, c) == doctest::Approx(9));
  CHECK(squared_distance(b, a, b, c) == 0);
}

TEST_CASE("distance_to_a_triangle_that_is_a_segment_or_a_point") {
  CHECK(squared_distance({1, 2, 0}, {0, 0, 0}, {1, 0, 0}, {3, 0, 0}) == doctest::Approx(4));
  CHECK(squared_distance({5, 0, 0}, {0, 0, 0}, {1, 0, 0}, {3, 0, 0}) == doctest::Approx(4));
  CHECK(squared_distance({0, 3, 4}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}) == doctest::Approx(25));
}
