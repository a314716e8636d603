#include "interact/cursor_projection.h"

#include <doctest/doctest.h>

#include "support/camera.h"

using namespace viete;
using namespace viete::document;
using namespace viete::interact;

namespace {

Camera camera(bool orthographic) {
  return test::camera({.orthographic = orthographic});
}

glm::dvec2 pixel(const Camera& c, const glm::dvec3& p) {
  return CursorProjection(p, c).at();
}

}  // namespace

TEST_CASE("a_sight_is_where_the_camera_projects_the_point") {
  for (const Camera& c : {camera(false), camera(true)}) {
    const glm::vec3 p(0.4f, -0.3f, 0.7f);
    const glm::vec4 clip = c.projection() * c.view() * glm::vec4(p, 1);
    const glm::dvec2 expected{(0.5 + 0.5 * clip.x / clip.w) * 1000, (0.5 - 0.5 * clip.y / clip.w) * 800};
    CHECK(glm::distance(pixel(c, glm::dvec3(p)), expected) < 0.01);
  }
}

TEST_CASE("motion_is_the_derivative_of_the_projection") {
  for (const Camera& c : {camera(false), camera(true)}) {
    const glm::dvec3 p(0.4, -0.3, 0.7);
    for (const auto& d : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0.6, 0, 0.8)}) {
      const glm::dvec2 expected = (pixel(c, p + 1e-4 * d) - pixel(c, p - 1e-4 * d)) / 2e-4;
      CHECK(glm::distance(CursorProjection(p, c).motion(d), expected) < 1e-3);
    }
  }
}

TEST_CASE("a_place_on_an_axis_is_found_again_from_its_pixel") {
  for (const Camera& c : {camera(false), camera(true)}) {
    const glm::dvec3 p(0.4, -0.3, 0.7);
    const CursorProjection projection(p, c);
    for (const auto& axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)})
      for (const double t : {-0.5, 0.0, 0.01, 0.8})
        CHECK(projection.along(axis, pixel(c, p + t * axis)) == doctest::Approx(t).epsilon(1e-5));
  }
}

TEST_CASE("an_axis_that_points_at_the_eye_does_not_run_away") {
  const Camera c = camera(false);
  const glm::dvec3 p(c.pose().target);
  const CursorProjection projection(p, c);
  CHECK(projection.along(projection.to_eye(), {900, 100}) == 0);
  // The cursor is beyond the vanishing point. The distance is finite and keeps its sign.
  const glm::dvec3 away = glm::normalize(glm::dvec3(c.forward()) + 0.3 * glm::dvec3(c.right()));
  const double far =
      projection.along(away, projection.at() + 10000.0 * glm::normalize(projection.motion(away)));
  CHECK(std::isfinite(far));
  CHECK(far > 0);
}

TEST_CASE("angles_about_an_axis_are_right_handed_and_true") {
  for (const Camera& c : {camera(false), camera(true)}) {
    const glm::dvec3 p(c.pose().target);
    const CursorProjection projection(p, c);
    for (const auto& axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}) {
      const PlaneAxes f = plane_axes(axis);
      CHECK(glm::distance(glm::cross(f.u, f.v), axis) < 1e-15);
      const auto at = [&](double a) {
        return *projection.angle(axis, pixel(c, p + 0.01 * (std::cos(a) * f.u + std::sin(a) * f.v)));
      };
      CHECK(at(1.2) - at(0.2) == doctest::Approx(1).epsilon(1e-2));
      CHECK(at(-2.0) - at(-3.0) == doctest::Approx(1).epsilon(1e-2));
    }
  }
}

TEST_CASE("an_edge_on_ring_has_no_angle_but_its_near_side_follows_the_cursor") {
  Camera c = camera(false);
  c.look(StandardView::front);
  c.animate(1);
  const CursorProjection projection(glm::dvec3(c.pose().target), c);
  CHECK_FALSE(projection.angle({1, 0, 0}, {700, 300}));
  // If the near side of a ring about +x moves up, the rotation is negative.
  CHECK(projection.edge_on_angle({1, 0, 0}, {0, -84}, 84) == doctest::Approx(-1));
}

TEST_CASE("planes_are_hit_where_the_ray_meets_them_and_not_beyond_their_horizon") {
  const Camera c = camera(false);
  const glm::dvec3 p(c.pose().target), up(0, 1, 0);
  const CursorProjection projection(p, c);
  const auto hit = projection.in_plane(up, c.ray({700, 500}));
  REQUIRE(hit);
  CHECK(hit->y == doctest::Approx(p.y));
  CHECK(glm::distance(pixel(c, *hit), glm::dvec2(700, 500)) < 0.01);
  CHECK_FALSE(projection.in_plane(up, c.ray({700, -5000})));
}
