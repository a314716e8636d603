#include "render/shadow_layer.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace viete;
using render::GroundShadow;

namespace {

// A square of side 0.4 around (x, y) at a height.
std::vector<glm::vec3> square(float x, float y, float height) {
  std::vector<glm::vec3> points;
  for (int i = 0; i <= 80; ++i) {
    for (int j = 0; j <= 80; ++j)
      points.emplace_back(x - 0.2F + 0.005F * float(i), y - 0.2F + 0.005F * float(j), height);
  }
  return points;
}

double darkness_at(const GroundShadow& s, float x, float y) {
  const glm::ivec2 cell((glm::vec2(x, y) - s.low) / s.cell);
  if (cell.x < 0 || cell.y < 0 || cell.x >= s.width || cell.y >= s.height) return 0;
  return s.darkness[static_cast<std::size_t>(cell.y) * s.width + cell.x] / 255.0;
}

}  // namespace

TEST_CASE("shadow_is_dark_below_what_touches_the_ground_and_faint_below_what_is_high") {
  const auto at_height = [](float h) { return darkness_at(render::ground_shadow(square(0, 0, h), 1), 0, 0); };
  CHECK(at_height(0) > 0.85);
  CHECK(at_height(0.1F) < at_height(0));
  CHECK(at_height(0.6F) < at_height(0.1F));
  CHECK(at_height(4) < 0.01);
}

TEST_CASE("shadow_lies_where_its_points_are_and_ends_softly_before_its_edges") {
  const GroundShadow shadow = render::ground_shadow(square(3, -2, 0.02F), 1);
  CHECK(darkness_at(shadow, 3, -2) > 0.7);
  CHECK(darkness_at(shadow, 3.25F, -2) < 0.4);
  CHECK(darkness_at(shadow, 3.25F, -2) > 0.05);
  for (int x = 0; x < shadow.width; ++x) CHECK(shadow.darkness[x] == 0);
  for (int y = 0; y < shadow.height; ++y)
    CHECK(shadow.darkness[static_cast<std::size_t>(y + 1) * shadow.width - 1] == 0);
}

TEST_CASE("what_is_below_the_ground_casts_no_shadow_on_it") {
  CHECK(darkness_at(render::ground_shadow(square(0, 0, -0.3F), 1), 0, 0) == 0);
}

TEST_CASE("squares_of_a_shadow_cover_all_that_is_dark") {
  const GroundShadow shadow = render::ground_shadow(square(0, 0, 0.1F), 1);
  constexpr int side = GroundShadow::square;
  CHECK(shadow.squares.size() < std::size_t(shadow.width / side) * std::size_t(shadow.height / side));
  for (int y = 0; y < shadow.height; ++y) {
    for (int x = 0; x < shadow.width; ++x) {
      if (shadow.darkness[static_cast<std::size_t>(y) * shadow.width + x] < 2) continue;
      const std::array<std::uint32_t, 2> square{std::uint32_t(x / side), std::uint32_t(y / side)};
      CHECK(std::ranges::count(shadow.squares, square) == 1);
    }
  }
}

TEST_CASE("no_points_and_points_far_apart_make_a_shadow_of_bounded_size") {
  CHECK(render::ground_shadow({}, 1).squares.empty());
  const std::vector<glm::vec3> apart{{-1e20F, 0, 0}, {1e20F, 3, 0}};
  const GroundShadow shadow = render::ground_shadow(apart, 1);
  CHECK(shadow.width <= 256);
  CHECK(shadow.height <= 256);
}

TEST_CASE("points_are_spread_over_triangles_by_their_areas") {
  const std::vector<render::Point> corners{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {9, 0, 0}, {10, 0, 0}, {9, 1, 0}};
  const std::vector<render::Triangle> triangles{{0, 1, 2}, {3, 4, 5}, {0, 0, 1}};
  const render::SpreadPoints spread(triangles, corners);
  std::size_t large = 0;
  glm::dvec2 mean(0);
  for (const auto& place : spread.places()) {
    CHECK(place.shares[0] + place.shares[1] + place.shares[2] == doctest::Approx(1));
    CHECK(*std::ranges::min_element(place.shares) > -1e-6F);
    if (place.corners[0] != 0) continue;
    ++large;
    mean += 3.0 * glm::dvec2(place.shares[1], place.shares[2]);
  }
  const auto count = static_cast<double>(spread.places().size());
  CHECK(count > 10000);
  CHECK(static_cast<double>(large) / count == doctest::Approx(0.9).epsilon(0.001));
  CHECK(mean.x / static_cast<double>(large) == doctest::Approx(1).epsilon(0.01));
  CHECK(mean.y / static_cast<double>(large) == doctest::Approx(1).epsilon(0.01));
}

TEST_CASE("points_past_all_cells_cast_no_shadow_and_leave_that_of_others") {
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  for (const float far : {1e8F, 1e30F, 3e38F, -1e30F, inf, -inf, nan}) {
    CAPTURE(far);
    for (const glm::vec3& stray : {glm::vec3(far, 0, 0), glm::vec3(0, far, 0), glm::vec3(0, 0, far)}) {
      std::vector<glm::vec3> points = square(0, 0, 0);
      points.push_back(stray);
      CHECK(darkness_at(render::ground_shadow(points, 1), 0, 0) > 0.85);
    }
    for (const float size : {1e-30F, 1.0F, far})
      CHECK(render::ground_shadow(std::vector{glm::vec3(far, far, 0)}, size).width <= 300);
  }
}
