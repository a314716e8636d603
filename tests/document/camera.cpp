#include "document/camera.h"

#include "interact/gizmo.h"
#include "support/camera.h"
#include "support/commands.h"
#include "support/cube.h"

using namespace viete::document;
using namespace viete::workspace;
using namespace viete;

namespace {

const Viewport whole_view{{1000, 800}, {0, 0}, {1000, 800}};

glm::vec2 pixel(const Camera& camera, const glm::vec3& p) {
  const Viewport& v = camera.viewport;
  const glm::vec4 clip = camera.projection() * camera.view() * glm::vec4(p, 1);
  return {(0.5f + 0.5f * clip.x / clip.w) * v.window.x, (0.5f - 0.5f * clip.y / clip.w) * v.window.y};
}

// Returns a bottle along the axis. One end is wide, and the other end is narrow.
OpenedSurface bottle(std::size_t axis, const std::string& format = "OBJ") {
  mesh::Surface cone = test::cube(1);
  for (auto& p : cone.positions) {
    const double height = p[axis];
    for (std::size_t k = 0; k < 3; ++k) p[k] *= k == axis ? 3 : height > 0 ? 0.1 : 1;
  }
  OpenedSurface opened = generated_surface(std::move(cone), "bottle");
  opened.format = format;
  return opened;
}

}  // namespace

TEST_CASE("the_target_is_in_the_middle_of_the_free_part_of_the_window") {
  Camera camera;
  for (const auto& v : {whole_view, test::camera().viewport}) {
    camera.viewport = v;
    const glm::vec2 at = pixel(camera, camera.pose().target);
    CHECK(at.x == doctest::Approx(v.origin.x + 0.5f * v.size.x).epsilon(1e-4));
    CHECK(at.y == doctest::Approx(v.origin.y + 0.5f * v.size.y).epsilon(1e-4));
  }
}

TEST_CASE("framed_points_fit_the_uncovered_free_part_of_the_window_and_nearly_fill_it") {
  std::vector<glm::vec3> points;
  for (int i = 0; i < 8; ++i) points.push_back({i & 1 ? 1 : 5, i & 2 ? -2 : 2, i & 4 ? 7 : 8});
  for (const bool orthographic : {false, true})
    for (const float covered : {0.0f, 220.0f}) {
      Camera camera = test::camera();
      camera.set_orthographic(orthographic);
      camera.frame(points, false, covered);
      glm::vec2 low(1e9f), high(-1e9f);
      for (const auto& p : points) {
        const glm::vec2 at = pixel(camera, p);
        low = glm::min(low, at);
        high = glm::max(high, at);
      }
      CHECK(low.x >= 320);
      CHECK(high.x <= 1000);
      CHECK(low.y >= 0);
      CHECK(high.y <= 774 - covered);
      CHECK(std::max((high.x - low.x) / 680, (high.y - low.y) / (774 - covered)) > 0.75f);
    }
}

TEST_CASE("a_single_point_is_framed_from_a_finite_distance") {
  Camera camera = test::camera();
  const glm::vec3 one[] = {{1, 2, 3}};
  camera.frame(one, false);
  CHECK(camera.pose().target == one[0]);
  CHECK(camera.pose().distance > 0.1f);
}

TEST_CASE("panning_moves_the_target_with_the_hand") {
  Camera camera;
  camera.viewport = whole_view;
  const glm::vec3 target = camera.pose().target;
  camera.pan({30, -20});
  const glm::vec2 at = pixel(camera, target);
  CHECK(at.x == doctest::Approx(530).epsilon(1e-3));
  CHECK(at.y == doctest::Approx(380).epsilon(1e-3));
}

TEST_CASE("orbiting_keeps_target_and_distance_and_stops_at_the_poles") {
  Camera camera = test::camera();
  camera.orbit({100, 10000});
  CHECK(camera.pose().pitch == doctest::Approx(1.5707963));
  CHECK(glm::distance(camera.eye(), camera.pose().target) == doctest::Approx(camera.pose().distance));
  CHECK(std::isfinite(camera.view()[0][0]));
}

TEST_CASE("standard_views_look_along_the_axes_after_150_ms") {
  const struct {
    StandardView view;
    glm::vec3 forward;
  } cases[] = {{StandardView::front, {0, 0, -1}}, {StandardView::back, {0, 0, 1}},
               {StandardView::right, {-1, 0, 0}}, {StandardView::left, {1, 0, 0}},
               {StandardView::top, {0, -1, 0}},   {StandardView::bottom, {0, 1, 0}}};
  for (const auto& c : cases) {
    Camera camera = test::camera();
    camera.look(c.view);
    CHECK(camera.moving());
    camera.animate(0.1f);
    CHECK(camera.moving());
    camera.animate(0.06f);
    CHECK_FALSE(camera.moving());
    CHECK(glm::distance(camera.forward(), c.forward) < 1e-5f);
  }
}

TEST_CASE("orthographic_shows_the_target_plane_as_perspective_does_and_every_depth_alike") {
  Camera camera = test::camera();
  const glm::vec3 target = camera.pose().target, side = target + 0.4f * camera.right() - 0.2f * camera.up();
  const glm::vec2 before = pixel(camera, side);
  camera.set_orthographic(true);
  CHECK(glm::distance(pixel(camera, side), before) < 0.05f);
  const glm::vec3 behind_the_eye = side - 9.0f * camera.forward();
  CHECK(glm::distance(pixel(camera, behind_the_eye), before) < 0.05f);
  camera.set_orthographic(false);
  CHECK(camera.pose() == CameraPose{});
}

TEST_CASE("zooming_keeps_the_point_under_the_cursor_in_orthographic_views_at_any_depth") {
  const glm::vec2 cursor(700, 250);
  for (const bool orthographic : {false, true}) {
    Camera camera = test::camera();
    camera.set_orthographic(orthographic);
    const Ray ray = camera.ray(cursor);
    const double target = camera.pose().distance / glm::dot(ray.direction, glm::dvec3(camera.forward()));
    for (const double depth : orthographic ? std::vector{0.0, 3.0, 9.0} : std::vector{target}) {
      Camera zoomed = camera;
      const glm::vec3 under(ray.origin + depth * ray.direction);
      zoomed.zoom(3, cursor);
      CHECK(glm::distance(pixel(zoomed, under), cursor) < (orthographic ? 0.1f : 0.5f));
      CHECK(zoomed.pose().distance < camera.pose().distance);
    }
  }
}

TEST_CASE("a_ray_holds_all_points_under_its_pixel") {
  for (const bool orthographic : {false, true}) {
    Camera camera = test::camera();
    camera.set_orthographic(orthographic);
    const glm::vec2 cursor(430, 611);
    const Ray ray = camera.ray(cursor);
    CHECK(glm::length(ray.direction) == doctest::Approx(1));
    for (const double t : {0.5, 4.0, 12.0})
      CHECK(glm::distance(pixel(camera, glm::vec3(ray.origin + t * ray.direction)), cursor) < 0.05f);
  }
}

TEST_CASE("an_eased_view_stays_orthographic_switching_meanwhile_lasts_and_orbiting_ends_it") {
  Camera camera = test::camera();
  camera.set_orthographic(true);
  camera.look(StandardView::top);
  camera.animate(0.05f);
  CHECK(camera.pose().orthographic);
  camera.set_orthographic(false);
  camera.animate(0.05f);
  CHECK_FALSE(camera.pose().orthographic);
  camera.orbit({1, 0});
  CHECK_FALSE(camera.moving());
}

TEST_CASE("a_camera_clamps_every_input") {
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  const auto is_sane = [](const CameraPose& p) {
    const float far = static_cast<float>(farthest_place);
    for (int i = 0; i < 3; ++i)
      if (!(std::abs(p.target[i]) <= far)) return false;
    return p.distance >= nearest_camera && p.distance <= farthest_camera && std::isfinite(p.yaw) &&
           std::abs(p.pitch) <= 1.5708f;
  };
  for (const float x : {3e38f, -3e38f, inf, -inf, nan}) {
    Camera camera = test::camera();
    camera.set_pose({{x, 0, x}, x, x, x});
    CHECK(is_sane(camera.pose()));
    const glm::vec3 points[] = {{x, 0, 0}, {0, -x, 0}, {1, 2, 3}};
    for (const bool eased : {false, true}) {
      camera.frame(points, eased);
      CHECK(is_sane(camera.pose()));
      CHECK(is_sane(camera.destination()));
    }
    while (camera.animate(0.01f)) CHECK(is_sane(camera.pose()));
  }
  Camera camera = test::camera();
  camera.set_pose({{0, 0, 0}, farthest_camera, 0, 0});
  for (int i = 0; i < 10000; ++i) camera.pan({800, 0});
  CHECK(is_sane(camera.pose()));
}

TEST_CASE("a_model_stands_on_its_broad_end") {
  CHECK(guessed_up(bottle(1)) == UpAxis::y);
  CHECK(guessed_up(bottle(2)) == UpAxis::z);
  CHECK(guessed_up(bottle(1, "STL binary")) == UpAxis::z);
  CHECK(guessed_up(bottle(2, "glTF binary")) == UpAxis::y);
  OpenedSurface cube = generated_surface(test::cube(1), "cube");
  CHECK(guessed_up(cube) == UpAxis::y);
}

TEST_CASE("with_z_up_the_camera_turns_about_z_and_files_stay_as_they_are") {
  Workspace w = test::cube_workspace();
  const auto before = w.document.model().surface->positions;
  w.view.camera.set_pose({.yaw = 0, .pitch = 0, .up = UpAxis::z});
  CHECK(w.view.camera.up().z == doctest::Approx(1));
  CHECK(w.view.camera.forward().y == doctest::Approx(1));
  CHECK(w.view.camera.right().x == doctest::Approx(1));
  w.view.camera.orbit({200, -30});
  CHECK(w.view.camera.right().z == doctest::Approx(0));
  CHECK(w.view.camera.up().z > 0.5f);
  w.view.camera.look(StandardView::top);
  w.view.camera.animate(1);
  CHECK(w.view.camera.forward().z == doctest::Approx(-1));
  CHECK(w.view.camera.pose().up == UpAxis::z);
  REQUIRE(test::run_command(w, "toggle_z_up"));
  CHECK(w.view.camera.pose().up == UpAxis::y);
  REQUIRE(test::run_command(w, "toggle_y_down"));
  w.view.camera.set_pose({.yaw = 0, .pitch = 0, .up = w.view.camera.pose().up});
  CHECK(w.view.camera.up().y == doctest::Approx(-1));
  CHECK(w.view.camera.forward().z == doctest::Approx(1));
  CHECK(w.view.camera.right().x == doctest::Approx(1));
  REQUIRE(test::run_command(w, "toggle_y_down"));
  CHECK(w.view.camera.pose().up == UpAxis::y);
  CHECK(w.document.model().surface->positions == before);
}
