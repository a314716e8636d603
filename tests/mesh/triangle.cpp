#include "mesh/triangle.h"

#include <doctest/doctest.h>

#include <random>

using namespace viete::mesh;

namespace {

class Random {
public:
  explicit Random(unsigned seed) : engine_(seed) {}

  Vec3 vector(double size) {
    std::uniform_real_distribution<double> number(-size, size);
    return {number(engine_), number(engine_), number(engine_)};
  }

private:
  std::mt19937_64 engine_;
};

Vec3 point(const Closest& c, const Vec3& a, const Vec3& b, const Vec3& d) {
  return c.barycentric[0] * a + c.barycentric[1] * b + c.barycentric[2] * d;
}

// By brute force: the best of a fine grid on the triangle.
double sampled(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr int n = 60;
  double best = HUGE_VAL;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j) {
      const double s = double(i) / n, t = double(j) / n;
      best = std::min(best, norm(p - ((1 - s - t) * a + s * b + t * c)));
    }
  }
  return best;
}

}  // namespace

TEST_CASE("distance_agrees_with_a_sampled_triangle_on_both_sides") {
  Random random(2);
  for (int n = 0; n < 200; ++n) {
    const Vec3 a = random.vector(1), b = random.vector(1), c = random.vector(1), p = random.vector(2);
    const Closest closest = closest_on_triangle(p, a, b, c);
    const double d = std::sqrt(closest.squared_distance), grid = sampled(p, a, b, c);
    CHECK(d <= grid + 1e-14);
    CHECK(d >= grid - 0.05);
    CHECK(norm(p - point(closest, a, b, c)) == doctest::Approx(d).epsilon(1e-12));
  }
}

TEST_CASE("barycentric_coordinates_are_inside_and_sum_to_one") {
  Random random(3);
  for (int n = 0; n < 1000; ++n) {
    const auto w = closest_on_triangle(random.vector(2), random.vector(1), random.vector(1), random.vector(1))
                       .barycentric;
    CHECK(w[0] + w[1] + w[2] == doctest::Approx(1).epsilon(1e-15));
    CHECK(std::min({w[0], w[1], w[2]}) >= -1e-15);
  }
}

TEST_CASE("distance_above_and_below_the_plane_is_the_height") {
  for (const double h : {1.0, -1.0, 1e-9, -1e-9, 0.0}) {
    const double d2 = closest_on_triangle({0.25, 0.25, h}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}).squared_distance;
    CHECK(std::sqrt(d2) == doctest::Approx(std::abs(h)).epsilon(1e-12));
  }
}

TEST_CASE("distance_to_corners_and_edges_is_exact") {
  const Vec3 a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0};
  CHECK(closest_on_triangle({-3, -4, 0}, a, b, c).squared_distance == 25);
  CHECK(closest_on_triangle({7, 0, 4}, a, b, c).squared_distance == 25);
  CHECK(closest_on_triangle({0, 8, 3}, a, b, c).squared_distance == 25);
  CHECK(closest_on_triangle({2, -3, 4}, a, b, c).squared_distance == 25);
  CHECK(closest_on_triangle({-3, 2, 4}, a, b, c).squared_distance == 25);
  CHECK(closest_on_triangle({5, 5, 0}, a, b, c).squared_distance == 18);
}

TEST_CASE("a_triangle_without_area_is_a_segment_or_a_point") {
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{3, 0, 0};
  for (const auto& [x, d2] : {std::pair{2.0, 1.0}, {-1.0, 2.0}, {4.0, 2.0}, {0.5, 1.0}}) {
    CHECK(closest_on_triangle({x, 1, 0}, a, b, c).squared_distance == doctest::Approx(d2));
    CHECK(closest_on_triangle({x, 1, 0}, c, a, b).squared_distance == doctest::Approx(d2));
    CHECK(closest_on_triangle({x, 1, 0}, b, c, a).squared_distance == doctest::Approx(d2));
  }
  CHECK(closest_on_triangle({1, 2, 2}, a, a, a).squared_distance == 9);
  CHECK(closest_on_triangle({1, 2, 0}, a, a, c).squared_distance == 4);
}

TEST_CASE("distance_scales_with_the_scene_from_1e-30_to_1e30") {
  Random random(4);
  for (const double s : {1e-30, 1e-10, 1e10, 1e30}) {
    for (int n = 0; n < 50; ++n) {
      const Vec3 a = random.vector(1), b = random.vector(1), c = random.vector(1), p = random.vector(2);
      const double d = std::sqrt(closest_on_triangle(p, a, b, c).squared_distance);
      CHECK(std::sqrt(closest_on_triangle(s * p, s * a, s * b, s * c).squared_distance) ==
            doctest::Approx(s * d).epsilon(1e-9));
    }
  }
}

TEST_CASE("a_triangle_has_area_unless_rounding_is_all_it_has_at_every_scale") {
  for (const double scale : {1e-300, 1e-30, 1.0, 1e30, 1e99}) {
    const Vec3 a{0, 0, 0}, b{scale, 0, 0}, c{2 * scale, 0, 0};
    CHECK(has_area(a, b, {0, scale, 0}));
    CHECK(has_area(a, b, {0.5 * scale, 2e-12 * scale, 0}));
    CHECK_FALSE(has_area(a, b, {0.5 * scale, 0.5e-12 * scale, 0}));
    CHECK_FALSE(has_area(a, b, c));
    CHECK_FALSE(has_area(a, b, b));
    CHECK_FALSE(has_area(b, b, b));
  }
}
