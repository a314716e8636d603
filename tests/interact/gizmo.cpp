#include "interact/gizmo.h"

#include <doctest/doctest.h>

#include "support/camera.h"
#include "support/cube.h"
#include "support/grips.h"

using namespace viete;
using namespace viete::document;
using namespace viete::interact;
using namespace viete::workspace;
using Kind = Constraint::Kind;

namespace {

Camera camera(float yaw = 0.65f, float pitch = 0.32f, float distance = 4, bool orthographic = false) {
  return test::camera({{0, 0, 0}, distance, yaw, pitch, orthographic});
}

DragGuides guides(Tool tool, Constraint constraint, const char* typed) {
  Workspace w = test::cube_workspace();
  w.document.changed_selection().select_all(8);
  auto& view = w.view;
  TransformDrag drag(w.document, test::plain_grip(w.document), tool, constraint, 1, {700, 390}, view.camera);
  for (; *typed; ++typed) drag.type(*typed);
  drag.update(w.document, {{710, 390}}, view.camera);
  return drag_guides(drag, w.document.space(), view.camera);
}

const AxisBall& ball(const AxisWidget& widget, int axis, bool positive) {
  for (const auto& b : widget.balls)
    if (b.axis == axis && b.positive == positive) return b;
  FAIL("no such ball");
  return widget.balls[0];
}

}  // namespace

TEST_CASE("the_gizmo_has_the_same_size_in_pixels_at_every_distance_and_in_both_cameras") {
  const auto reference = *make_gizmo(Tool::move, {0, 0, 0}, glm::dmat3(1), camera());
  for (const bool orthographic : {false, true}) {
    for (const float distance : {0.05f, 1.0f, 200.0f}) {
      const auto gizmo =
          *make_gizmo(Tool::move, {0, 0, 0}, glm::dmat3(1), camera(0.65f, 0.32f, distance, orthographic));
      for (int i = 0; i < 3; ++i) {
        const float length = glm::distance(gizmo.center, gizmo.arms[i].tip);
        // In perspective, an arm is a few percent longer if it points at the viewer.
        CHECK(length ==
              doctest::Approx(glm::distance(reference.center, reference.arms[i].tip)).epsilon(0.06));
      }
    }
  }
}

TEST_CASE("each_handle_is_hit_where_it_is_drawn") {
  for (const Tool tool : {Tool::move, Tool::scale}) {
    const auto gizmo = *make_gizmo(tool, {0.2, -0.1, 0.3}, glm::dmat3(1), camera());
    CHECK(pick_handle(gizmo, gizmo.center) == Constraint{});
    for (int i = 0; i < 3; ++i) {
      CHECK(pick_handle(gizmo, gizmo.arms[i].tip) == Constraint{Kind::axis, i});
      CHECK(pick_handle(gizmo, 0.5f * (gizmo.arms[i].tip + gizmo.arms[i].end)) == Constraint{Kind::axis, i});
      const auto& corners = gizmo.planes[i].corners;
      CHECK(pick_handle(gizmo, 0.5f * (corners[0] + corners[2])) == Constraint{Kind::plane, i});
    }
    CHECK_FALSE(pick_handle(gizmo, gizmo.center + glm::vec2(200, 0)));
  }
}

TEST_CASE("rings_are_hit_on_the_viewers_side_and_the_outer_one_all_around") {
  const auto gizmo = *make_gizmo(Tool::rotate, {0, 0, 0}, glm::dmat3(1), camera());
  for (int i = 0; i < 3; ++i) {
    int front = 0;
    for (const auto& point : gizmo.rings[i]) {
      if (!point.front) continue;
      ++front;
      CHECK(pick_handle(gizmo, point.at));
    }
    CHECK(front >= 46);
    CHECK(front <= 52);
  }
  for (const auto& d : {glm::vec2(1, 0), glm::vec2(0, -1), glm::vec2(-0.6f, 0.8f)})
    CHECK(pick_handle(gizmo, gizmo.center + gizmo_view_ring * d) == Constraint{});
  CHECK_FALSE(pick_handle(gizmo, gizmo.center + glm::vec2(130, 0)));
}

TEST_CASE("reach_hits_handles_from_farther_and_the_far_side_of_rings") {
  const auto gizmo = *make_gizmo(Tool::rotate, {0, 0, 0}, glm::dmat3(1), camera());
  const glm::vec2 outside = gizmo.center + glm::vec2(gizmo_view_ring + gizmo_tolerance + 4, 0);
  CHECK_FALSE(pick_handle(gizmo, outside));
  CHECK(pick_handle(gizmo, outside, true) == Constraint{});
  CHECK_FALSE(pick_handle(gizmo, outside + glm::vec2(gizmo_reach, 0), true));
  for (int i = 0; i < 3; ++i)
    for (const auto& point : gizmo.rings[i]) CHECK(pick_handle(gizmo, point.at, true));
  const auto arms = *make_gizmo(Tool::move, {0, 0, 0}, glm::dmat3(1), camera());
  const glm::vec2 shaft = arms.arms[1].tip - arms.arms[1].base,
                  beside = 0.5f * (arms.arms[1].tip + arms.arms[1].base) +
                           11.0f / glm::length(shaft) * glm::vec2(-shaft.y, shaft.x);
  CHECK(pick_handle(arms, beside, true) == Constraint{Kind::axis, 1});
}

TEST_CASE("handles_that_point_at_the_viewer_fade_and_cannot_be_hit") {
  const auto gizmo = *make_gizmo(Tool::move, {0, 0, 0}, glm::dmat3(1), camera(0, 0));
  CHECK(gizmo.arms[2].opacity == 0);
  CHECK(gizmo.arms[0].opacity == 1);
  CHECK(gizmo.planes[2].opacity == 1);
  CHECK(gizmo.planes[0].opacity == 0);
  CHECK(pick_handle(gizmo, gizmo.arms[2].tip) == Constraint{});
  CHECK(gizmo.far_to_near[2] == 2);
}

TEST_CASE("moves_and_scales_show_the_axes_they_go_along") {
  CHECK(guides(Tool::move, {Kind::axis, 1}, "").axes == std::vector<int>{1});
  CHECK(guides(Tool::scale, {Kind::plane, 1}, "").axes == std::vector<int>{0, 2});
  CHECK(guides(Tool::move, {}, "").axes.empty());
  CHECK(guides(Tool::move, {}, "").arc.empty());
  for (const auto& d : guides(Tool::move, {Kind::plane, 0}, "").axis_directions)
    CHECK(glm::length(d) == doctest::Approx(1));
}

TEST_CASE("turns_show_the_sector_they_sweep_and_count_whole_turns") {
  const DragGuides some = guides(Tool::rotate, {Kind::axis, 1}, "60");
  CHECK(some.whole_turns == 0);
  CHECK(some.circle.empty());
  CHECK(some.arc.size() > 10);
  const DragGuides many = guides(Tool::rotate, {Kind::axis, 1}, "780");
  CHECK(many.whole_turns == 2);
  CHECK(glm::distance(many.arc.back(), some.arc.back()) < 0.01f);
  CHECK(glm::distance(many.circle.front(), many.circle.back()) < 0.01f);
}

TEST_CASE("the_widget_is_at_the_top_right_and_its_balls_point_where_the_axes_do") {
  Camera camera = ::camera(0, 0);
  const auto widget = *axis_widget(camera);
  CHECK(widget.center.x > 900);
  CHECK(widget.center.y < 100);
  CHECK(widget.contains(widget.center));
  CHECK_FALSE(widget.contains({600, 400}));
  CHECK(ball(widget, 0, true).at.x > widget.center.x + 20);
  CHECK(ball(widget, 1, true).at.y < widget.center.y - 20);
  CHECK(ball(widget, 2, true).nearness == doctest::Approx(1));
  CHECK(ball(widget, 2, false).nearness == doctest::Approx(-1));
  CHECK(widget.ball(widget.center)->positive);
  camera.viewport = {{400, 100}, {320, 0}, {80, 74}};
  CHECK_FALSE(axis_widget(camera));
}

TEST_CASE("each_ball_looks_from_its_own_side_and_once_more_from_the_other") {
  for (int i = 0; i < 12; ++i) {
    const int axis = i % 3;
    const bool positive = i < 6;
    Camera camera = test::camera();
    camera.set_up(i / 3 % 2 == 0 ? UpAxis::y : UpAxis::z);
    look_from(camera, ball(*axis_widget(camera), axis, positive));
    camera.animate(1);
    CHECK(camera.forward()[axis] == doctest::Approx(positive ? -1 : 1));
    look_from(camera, ball(*axis_widget(camera), axis, positive));
    camera.animate(1);
    CHECK(camera.forward()[axis] == doctest::Approx(positive ? 1 : -1));
  }
}
