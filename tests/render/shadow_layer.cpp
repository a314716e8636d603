#include "render/shadow_layer.h"

#include <doctest/doctest.h>

#include "base/error.h"
#include "render/backdrop.h"
#include "support/stage.h"

using namespace viete;

namespace {

glm::dmat4 look_from(const glm::dvec3& eye, const glm::dvec3& up) {
  return glm::lookAt(eye, glm::dvec3(0), up);
}

// A ball that stands on the ground, on a white picture.
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
    stage.view.view = look_from(eye, up);
    render::Theme theme = render::light_theme();
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
  int least = 255;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) least = std::min<int>(least, image.pixel(x, y)[0]);
  }
  return least;
}

}  // namespace

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

TEST_CASE("no_shadow_is_seen_from_below") {
  Standing s(1);
  CHECK(darkest(s.seen_from({0, 12, 12}, {0, 1, 0})) < 190);
  CHECK(darkest(s.seen_from({0, -12, 12}, {0, 1, 0})) >= 254);
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

TEST_CASE("vertices_of_another_model_are_refused_and_those_that_are_not_finite_cast_none") {
  Standing s(1);
  CHECK_THROWS_AS(s.shadow.set_positions(std::vector<render::Point>(3)), base::Error);
  std::vector<render::SurfaceVertex> lost(s.ball.positions.size());
  for (auto& v : lost) v.position[0] = v.position[1] = v.position[2] = std::nanf("");
  s.shadow.set_vertices(lost, {0, 0, 0});
  CHECK(darkest(s.seen_from({0, 12, 12}, {0, 1, 0})) >= 254);
}
