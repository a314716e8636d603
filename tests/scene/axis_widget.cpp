#include "scene/hand/axis_widget.h"

#include <doctest/doctest.h>

#include "scene/viewport.h"

using namespace viete::scene;

namespace {

const AxisBall& ball(const AxisWidget& widget, int axis, bool positive) {
  for (const auto& b : widget.balls) {
    if (b.axis == axis && b.positive == positive) return b;
  }
  FAIL("no such ball");
  return widget.balls[0];
}

}  // namespace

TEST_CASE("the_widget_is_at_the_top_right_of_the_free_part_of_the_window") {
  const auto widget = *axis_widget(Camera(), viete::test::viewport);
  CHECK(widget.center.x > 900);
  CHECK(widget.center.y < 100);
  CHECK(widget.contains(widget.center));
  CHECK_FALSE(widget.contains({600, 400}));
  CHECK_FALSE(axis_widget(Camera(), {{400, 100}, {320, 0}, {80, 74}}));
}

TEST_CASE("balls_point_where_their_axes_do_on_screen") {
  Camera camera;
  camera.set_pose({{0, 0, 0}, 4, 0, 0, false});
  const auto widget = *axis_widget(camera, viete::test::viewport);
  CHECK(ball(widget, 0, true).at.x > widget.center.x + 20);
  CHECK(ball(widget, 1, true).at.y < widget.center.y - 20);
  CHECK(ball(widget, 2, true).nearness == doctest::Approx(1));
  CHECK(ball(widget, 2, false).nearness == doctest::Approx(-1));
  CHECK(widget.ball(widget.center)->positive);  // the nearest one
}

TEST_CASE("each_ball_looks_from_its_own_side_and_once_more_from_the_other") {
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool positive : {true, false}) {
      Camera camera;
      look_from(camera, ball(*axis_widget(camera, viete::test::viewport), axis, positive));
      camera.animate(1);
      CHECK(camera.forward()[axis] == doctest::Approx(positive ? -1 : 1));
      look_from(camera, ball(*axis_widget(camera, viete::test::viewport), axis, positive));
      camera.animate(1);
      CHECK(camera.forward()[axis] == doctest::Approx(positive ? 1 : -1));
    }
  }
}
