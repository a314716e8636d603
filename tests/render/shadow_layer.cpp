#include <limits>

#include "render/backdrop.h"
#include "render/shadow_layer.h"
#include "support/stage.h"

using namespace viete;
using render::GroundShadow;

namespace {

// Returns points of a horizontal square with the side 0.4. Its center is (x, y, height).
std::vector<glm::vec3> square(float x, float y, float height) {
  std::vector<glm::vec3> points;
  for (int i = 0; i < 81 * 81; ++i)
    points.emplace_back(x - 0.2F + 0.005F * float(i / 81), y - 0.2F + 0.005F * float(i % 81), height);
  return points;
}

double darkness_at(const GroundShadow& s, float x, float y) {
  const glm::ivec2 cell((glm::vec2(x, y) - s.low) / s.cell);
  if (cell.x < 0 || cell.y < 0 || cell.x >= s.width || cell.y >= s.height) return 0;
  return s.darkness[static_cast<std::size_t>(cell.y) * s.width + cell.x] / 255.0;
}

// A ball on the ground. The background is white.
struct Standing {
  explicit Standing(int up) : shadow(stage.gl), backdrop(stage.gl) {
    glm::dvec3 middle(0);
    middle[up] = 2;
    ball = test::ball(2, {middle.x, middle.y, middle.z});
    shadow.set_triangles(ball.triangles, ball.positions);
    style.up = up;
    style.size = 4;
  }
  render::Image seen_from(const glm::dvec3& eye, const glm::dvec3& up) {
    stage.view.view = glm::lookAt(eye, glm::dvec3(0), up);
    render::Theme theme = render::theme(false);
    theme.background_top = theme.background_bottom = glm::vec3(1);
    return stage.picture([&] {
      backdrop.draw(theme);
      shadow.draw(stage.view, theme, style);
    });
  }

  test::Stage stage;
  render::ShadowLayer shadow;
  render::Backdrop backdrop;
  render::ShadowStyle style;
  test::Ball ball;
};

int darkest(const render::Image& image) {
  return *std::ranges::min_element(image.rgba);
}

}  // namespace

TEST_CASE("shadow_is_dark_below_contact_and_faint_below_height") {
  const auto at_height = [](float h) { return darkness_at(render::ground_shadow(square(0, 0, h), 1), 0, 0); };
  CHECK(at_height(0) > 0.85);
  CHECK(at_height(0.1F) < at_height(0));
  CHECK(at_height(0.6F) < at_height(0.1F));
  CHECK(at_height(4) < 0.01);
  CHECK(at_height(-0.3F) == 0);
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

TEST_CASE("squares_of_a_shadow_cover_all_that_is_dark") {
  const GroundShadow shadow = render::ground_shadow(square(0, 0, 0.1F), 1);
  constexpr int side = GroundShadow::square;
  CHECK(shadow.squares.size() < std::size_t(shadow.width / side) * std::size_t(shadow.height / side));
  for (int y = 0; y < shadow.height; ++y)
    for (int x = 0; x < shadow.width; ++x) {
      if (shadow.darkness[static_cast<std::size_t>(y) * shadow.width + x] < 2) continue;
      const std::array<std::uint32_t, 2> square{std::uint32_t(x / side), std::uint32_t(y / side)};
      CHECK(std::ranges::count(shadow.squares, square) == 1);
    }
}

TEST_CASE("points_are_spread_over_triangles_by_their_areas") {
  const std::vector<render::Point> corners{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {9, 0, 0}, {10, 0, 0}, {9, 1, 0}};
  const std::vector<render::Triangle> triangles{{0, 1, 2}, {3, 4, 5}, {0, 0, 1}};
  const auto spread = render::spread_points(triangles, corners);
  std::size_t large = 0;
  glm::dvec2 mean(0);
  for (const auto& place : spread) {
    CHECK(place.shares[0] + place.shares[1] + place.shares[2] == doctest::Approx(1));
    CHECK(*std::ranges::min_element(place.shares) > -1e-6F);
    if (place.corners[0] != 0) continue;
    ++large;
    mean += 3.0 * glm::dvec2(place.shares[1], place.shares[2]);
  }
  const auto count = static_cast<double>(spread.size());
  CHECK(count > 10000);
  CHECK(static_cast<double>(large) / count == doctest::Approx(0.9).epsilon(0.001));
  CHECK(mean.x / static_cast<double>(large) == doctest::Approx(1).epsilon(0.01));
  CHECK(mean.y / static_cast<double>(large) == doctest::Approx(1).epsilon(0.01));
}

TEST_CASE("points_beyond_the_grid_cast_no_shadow") {
  CHECK(render::ground_shadow({}, 1).squares.empty());
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

TEST_CASE("shadow_is_on_the_ground_below_the_model_whichever_axis_is_up") {
  for (const int up : {1, 2}) {
    Standing s(up);
    glm::dvec3 eye(0, 12, 12), above(0);
    above[up] = 1;
    const render::Image image = s.seen_from(eye, above);
    const glm::ivec2 foot = s.stage.pixel_of({0, 0, 0});
    CHECK(image.pixel(foot.x, foot.y)[0] < 190);
    CHECK(image.pixel(5, 5)[0] >= 254);
  }
}

TEST_CASE("shadow_is_above_the_model_if_the_axis_points_down") {
  Standing s(1);
  s.style.down = true;
  s.style.center = {0, 4, 0};
  const render::Image image = s.seen_from({0, -12, 12}, {0, -1, 0});
  const glm::ivec2 foot = s.stage.pixel_of({0, 4, 0});
  CHECK(image.pixel(foot.x, foot.y)[0] < 190);
  s.style.down = false;
  CHECK(s.seen_from({0, -12, 12}, {0, -1, 0}).pixel(foot.x, foot.y)[0] >= 254);
}

TEST_CASE("shadow_follows_the_model") {
  Standing s(1);
  const glm::dvec3 eye(0, 14, 10);
  auto moved = s.ball.positions;
  for (auto& p : moved) p[0] += 3;
  s.seen_from(eye, {0, 1, 0});
  s.shadow.set_positions(moved);
  const render::Image image = s.seen_from(eye, {0, 1, 0});
  const glm::ivec2 now = s.stage.pixel_of({3, 0, 0}), before = s.stage.pixel_of({-1, 0, 0});
  CHECK(image.pixel(now.x, now.y)[0] < 190);
  CHECK(image.pixel(before.x, before.y)[0] > 240);
}

TEST_CASE("shadow_is_invisible_from_below_and_without_finite_vertices") {
  Standing s(1);
  CHECK(darkest(s.seen_from({0, 12, 12}, {0, 1, 0})) < 190);
  CHECK(darkest(s.seen_from({0, -12, 12}, {0, 1, 0})) >= 254);
  CHECK_THROWS_AS(s.shadow.set_positions(std::vector<render::Point>(3)), base::Error);
  std::vector<render::SurfaceVertex> lost(s.ball.positions.size());
  for (auto& v : lost) v.position[0] = v.position[1] = v.position[2] = std::nanf("");
  s.shadow.set_vertices(lost, {0, 0, 0});
  CHECK(darkest(s.seen_from({0, 12, 12}, {0, 1, 0})) >= 254);
}

TEST_CASE("points_on_a_ball_cast_its_shadow") {
  Standing of_triangles(1), of_points(1);
  std::vector<test::Point> spiral;
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = 0; i < 30'000; ++i) {
    const double z = (2.0 * i + 1) / 30'000 - 1, turn = 2.399963 * i, r = std::sqrt(1 - z * z);
    spiral.push_back({2 * r * std::cos(turn), 2 + 2 * z, 2 * r * std::sin(turn)});
    all.push_back(i);
  }
  of_points.shadow.set_points(all, spiral);
  const auto darkness = [](Standing& scene) {
    return 320 * 200 - test::lit_area(scene.seen_from({0, 20, 0.01}, {0, 1, 0}));
  };
  CHECK(darkness(of_triangles) > 50);
  CHECK(darkness(of_points) == doctest::Approx(darkness(of_triangles)).epsilon(0.15));
  of_points.shadow.set_points({}, spiral);
  CHECK(darkness(of_points) == 0);
}
