// Which axis points up, and what is measured.
#include "scene/document/camera.h"

#include <doctest/doctest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/cube.h"
#include "scene/hand/axis_widget.h"
#include "support/commands.h"

using namespace viete;
using namespace viete::scene;

namespace {

// A bottle: broad at one end of an axis, a point at the other.
OpenedSurface bottle(std::size_t axis, const std::string& format = "OBJ") {
  mesh::Surface cone = test::cube(1);
  for (auto& p : cone.positions) {
    const double height = p[axis];
    for (std::size_t k = 0; k < 3; ++k) p[k] *= k == axis ? 3 : height > 0 ? 0.1 : 1;
  }
  OpenedSurface opened = made_surface(std::move(cone), "bottle");
  opened.format = format;
  return opened;
}

}  // namespace

TEST_CASE("a_model_stands_on_its_broad_end") {
  CHECK(guessed_up(bottle(1)) == UpAxis::y);
  CHECK(guessed_up(bottle(2)) == UpAxis::z);
  CHECK(guessed_up(bottle(1, "STL binary")) == UpAxis::z);
  CHECK(guessed_up(bottle(2, "glTF binary")) == UpAxis::y);
  OpenedSurface cube = made_surface(test::cube(1), "cube");
  CHECK(guessed_up(cube) == UpAxis::y);
}

TEST_CASE("with_z_up_the_camera_turns_about_z_and_files_stay_as_they_are") {
  Workspace w = test::cube_workspace();
  const auto before = w.document.model.surface->positions;
  w.camera.set_pose({.yaw = 0, .pitch = 0, .up = UpAxis::z});
  CHECK(w.camera.up().z == doctest::Approx(1));
  CHECK(w.camera.forward().y == doctest::Approx(1));
  CHECK(w.camera.right().x == doctest::Approx(1));
  w.camera.orbit({200, -30});
  CHECK(w.camera.right().z == doctest::Approx(0));
  CHECK(w.camera.up().z > 0.5f);
  w.camera.look(StandardView::top);
  w.camera.animate(1);
  CHECK(w.camera.forward().z == doctest::Approx(-1));
  CHECK(w.camera.pose().up == UpAxis::z);
  REQUIRE(test::run_command(w, "toggle_z_up"));
  CHECK(w.camera.pose().up == UpAxis::y);
  CHECK(w.document.model.surface->positions == before);
}

TEST_CASE("each_ball_of_the_axes_looks_along_its_axis_whatever_is_up") {
  for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool positive : {true, false}) {
        Camera camera;
        camera.set_up(up);
        AxisBall ball;
        ball.axis = axis;
        ball.positive = positive;
        camera.look(ball.view(up));
        camera.animate(1);
        CAPTURE(axis);
        CAPTURE(positive);
        CHECK(camera.forward()[axis] == doctest::Approx(positive ? -1 : 1));
      }
    }
  }
}
