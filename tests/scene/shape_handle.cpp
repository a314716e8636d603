#include "scene/hand/shape_handle.h"
#include "scene/hand/shaping.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace viete;
using namespace viete::scene;

namespace {

const Viewport handle_view{{1000, 800}, {0, 0}, {1000, 800}};
const Space handle_space{{0, 0, 0}, 0.5};

Camera looking_down_z(float yaw = 0) {
  Camera camera;
  CameraPose pose;
  pose.yaw = yaw, pose.pitch = 0;
  camera.set_pose(pose);
  return camera;
}

Shaping between_ends(Shape shape) {
  return {shape, {-1, 0, 0}, {1, 0, 0}, {0, 0, 1}, {}};
}

ShapeHandle handle_at(const Shaping& shaping, double amount, const Camera& camera) {
  const auto handle = shape_handle(shaping, amount, handle_space, camera, handle_view);
  REQUIRE(handle);
  return *handle;
}

double pulled(const Shaping& shaping, const HeldHandle& held, const glm::vec2& cursor, const Camera& camera) {
  return amount_by_handle(shaping, held, glm::dvec2(cursor), handle_space, camera, handle_view);
}

}  // namespace

TEST_CASE("the_handle_of_a_bend_is_at_the_bent_end_and_takes_it_along") {
  const Shaping bend = between_ends(Shape::bend);
  for (const float yaw : {0.0f, 0.6f}) {
    const Camera camera = looking_down_z(yaw);
    const ShapeHandle taken = handle_at(bend, 20, camera);
    CHECK(taken.contains(taken.knob));
    CHECK(taken.contains(taken.knob + glm::vec2(6, 6)));
    CHECK_FALSE(taken.contains(taken.way.front()));
    CHECK(glm::distance(taken.start.back(), taken.knob) > 20);
    const glm::vec2 off(3, -4);  // it was not taken at its middle
    for (const double wanted : {21.0, 65.0, -40.0, 20.0}) {
      const glm::vec2 cursor = handle_at(bend, wanted, camera).knob + off;
      CHECK(pulled(bend, {glm::dvec2(taken.knob + off), 20, 20}, cursor, camera) ==
            doctest::Approx(wanted).epsilon(1e-3));
    }
  }
}

TEST_CASE("the_handle_of_a_twist_turns_with_its_tick_and_counts_turns") {
  const Shaping twist = between_ends(Shape::twist);
  for (const float yaw : {0.6f, -0.9f}) {
    const Camera camera = looking_down_z(yaw);
    const ShapeHandle taken = handle_at(twist, 10, camera);
    CHECK(taken.contains(taken.ring[17]));
    CHECK_FALSE(taken.contains(taken.way.back()));
    HeldHandle held{glm::dvec2(taken.knob), 10, 10};
    for (double wanted = 30; wanted <= 790; wanted += 20) {
      held.amount = pulled(twist, held, handle_at(twist, wanted, camera).knob, camera);
      CHECK(held.amount == doctest::Approx(wanted).epsilon(1e-3));
    }
  }
}

TEST_CASE("a_twist_whose_ring_is_seen_edge_on_follows_the_cursor_too") {
  const Shaping twist = between_ends(Shape::twist);
  const Camera camera = looking_down_z();
  CameraPose pose = camera.pose();
  pose.orthographic = true;
  Camera flat;
  flat.set_pose(pose);
  const glm::vec2 knob = handle_at(twist, 0, flat).knob;
  const double up = pulled(twist, {glm::dvec2(knob), 0, 0}, knob - glm::vec2(0, 30), flat);
  const double down = pulled(twist, {glm::dvec2(knob), 0, 0}, knob + glm::vec2(0, 30), flat);
  CHECK(std::abs(up) > 5);
  CHECK(up == doctest::Approx(-down));
}

TEST_CASE("the_handle_of_a_taper_is_a_circle_that_grows_with_the_cursor") {
  const Shaping taper = between_ends(Shape::taper);
  const Camera camera = looking_down_z();
  const ShapeHandle one = handle_at(taper, 1, camera), two = handle_at(taper, 2, camera);
  const glm::vec2 center = one.way.back();
  const float radius = glm::distance(one.knob, center);
  CHECK(glm::distance(two.knob, center) == doctest::Approx(2 * radius));
  CHECK(one.contains(center + glm::vec2(0, radius)));
  CHECK_FALSE(one.contains(center));
  const HeldHandle held{glm::dvec2(center + glm::vec2(0, radius)), 1, 1};
  CHECK(pulled(taper, held, center + glm::vec2(2 * radius, 0), camera) == doctest::Approx(2));
  CHECK(pulled(taper, held, center, camera) == doctest::Approx(0));
}

TEST_CASE("what_has_no_ends_or_is_behind_the_camera_has_no_handle") {
  Camera camera = looking_down_z();
  CHECK_FALSE(shape_handle({Shape::push, {}, {}, {}, {{1, 0, 0}}}, 1, handle_space, camera, handle_view));
  CHECK_FALSE(shape_handle({}, 1, handle_space, camera, handle_view));
  Shaping bend = between_ends(Shape::bend);
  bend.to = {0, 0, 100};
  CHECK_FALSE(shape_handle(bend, 1, handle_space, camera, handle_view));
}

TEST_CASE("a_hinge_is_across_the_way_and_near_to_what_was_asked_for") {
  Shaping bend = between_ends(Shape::bend);
  CHECK(*hinge_near(bend, {0, 1, 0}) == glm::dvec3(0, 1, 0));
  const glm::dvec3 oblique = *hinge_near(bend, {3, 0, -2});
  CHECK(glm::distance(oblique, glm::dvec3(0, 0, -1)) < 1e-12);
  CHECK_FALSE(hinge_near(bend, {-1, 0, 0}));
}
