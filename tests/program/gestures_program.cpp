// Mouse and keyboard: the gizmo, typed numbers, soft selection, mirror, sets and painting.
#include <cmath>
#include <numbers>

#include "document/pose_edit.h"
#include "program/driver.h"
#include "support/grips.h"
#include "support/pictures.h"
#include "workspace/pointer.h"

using namespace viete;
using test::Dragon, test::Driver;
using Kind = interact::Constraint::Kind;

namespace {

constexpr double radians = std::numbers::pi / 180;

// Returns points after a rotation about a vertical line.
std::vector<mesh::Point> turned(std::vector<mesh::Point> points, const glm::dvec3& center, double degrees) {
  const double c = std::cos(degrees * radians), s = std::sin(degrees * radians);
  for (auto& p : points) {
    const double x = p[0] - center.x, z = p[2] - center.z;
    p = {center.x + c * x + s * z, p[1], center.z - s * x + c * z};
  }
  return points;
}

}  // namespace

TEST_CASE("a_ring_of_the_gizmo_turns_the_whole_cage_twice_round_and_the_model_rigidly") {
  Dragon d;
  d.select_whole_cage();
  const auto rest = d.checked_positions();
  const glm::dvec3 center = test::selection_center(d.document());
  d.press_key(workspace::Key::pad7);  // from above, the ring about Y is a circle
  d.settle();
  const glm::vec2 middle = workspace::gizmo_of(d.workspace())->center;
  const auto on_circle = [&](int i) {
    const double a = (45 - i * 15) * radians;  // at 45 degrees no other ring is close
    return middle + interact::gizmo_radius * glm::vec2(std::cos(a), std::sin(a));
  };
  d.move(on_circle(0));
  REQUIRE(d.workspace().view.interaction.handle == interact::Constraint{Kind::axis, 1});
  d.button(0, true);
  for (int i = 1; i <= 56; ++i) d.move(on_circle(i));
  const double degrees = d.workspace().view.interaction.drag->transform().degrees;
  CHECK(degrees == doctest::Approx(840).epsilon(1e-3));
  CHECK(d.workspace().view.interaction.drag->readout().starts_with("Y 84"));
  d.button(0, false);
  d.frame();
  CHECK(test::largest_distance(d.checked_positions(), turned(rest, center, degrees)) < 1e-12);
  d.press_key('Z', true);
  CHECK(d.checked_positions() == rest);
  d.press_key('Z', true, true);
  CHECK(d.document().pose().turns[0][1] == doctest::Approx(degrees * radians).epsilon(1e-9));
}

TEST_CASE("a_field_takes_a_number_and_names_the_reason_for_refusing_another") {
  Dragon d;
  const auto v = d.free_vertex();
  d.click(glm::round(d.vertex(v)));
  d.enter("transform_y", "1,5");
  const mesh::Point placed{d.rest()[v][0], 1.5, d.rest()[v][2]};
  CHECK(d.pose()[v] == placed);
  d.enter("transform_y", "1.234,5");
  CHECK(d.pose()[v] == placed);
  CHECK(d.last_message().find("\"1.234.5\" is not a number; nothing was changed") != std::string::npos);
  CHECK(d.edits() == 1);
  d.run("undo");
  d.click("select_all");
  d.click("strip/tool_rotate");
  const auto before = d.checked_positions();
  d.enter("transform_y", "90");
  CHECK(test::largest_distance(d.checked_positions(),
                               turned(before, test::selection_center(d.document()), 90)) < 1e-12);
  d.enter("transform_y", "1e15");
  CHECK(d.last_message() == "Rotated by 360,000 degrees, the maximum for one step");
}

TEST_CASE("a_double_click_centers_the_orbit_target_and_a_drag_right_after_a_click_is_none") {
  Dragon d;
  const auto v = d.free_vertex();
  d.click("strip/tool_select");  // this tool has no gizmo
  const auto before = d.workspace().view.camera.destination();
  d.click(d.vertex(v));
  d.drag(d.vertex(v), d.vertex(v) + glm::vec2(20, 20));
  CHECK(d.moved() == std::vector<std::uint32_t>{v});
  CHECK(d.workspace().view.camera.destination() == before);
  d.frame(60);
  const glm::vec2 at = d.vertex(v);
  d.click(at);
  d.click(at);
  d.settle();
  d.frame(30);
  const glm::vec2 middle = d.workspace().view.camera.viewport.middle();
  CHECK(glm::distance(d.vertex(v), middle) < 1.5f);
  d.drag({400, 740}, {480, 700}, 2);
  CHECK(glm::distance(d.vertex(v), middle) < 1.5f);
}

TEST_CASE("soft_selection_fades_the_colour_of_cage_edges_and_the_mirror_plane_is_shown_when_it_matters") {
  Dragon d("", test::with_pixels);
  const auto picture_at = [&](glm::vec2 pointer) {
    d.move(pointer);
    d.frame(3);
    d.settle();
    return d.picture();
  };
  constexpr glm::vec2 aside(1270, 780);
  const auto v = d.free_vertex();
  d.click(d.vertex(v));
  const auto plain = picture_at(aside);
  d.run("toggle_soft");
  const auto soft = picture_at(aside);
  std::size_t changed = 0;
  for (const auto& [a, b] : d.document().cage()->edges) {
    if (a != v && b != v) continue;
    const glm::ivec2 middle(glm::round(0.5f * (d.vertex(a) + d.vertex(b))));
    changed += plain.pixel(middle.x, middle.y) != soft.pixel(middle.x, middle.y);
  }
  CHECK(changed >= 3);
  d.run("toggle_soft");
  d.choose("mirror", "mirror_x");
  REQUIRE(workspace::mirror_of(d.workspace()));
  const auto without = picture_at(aside);
  const double plane = 0.0195;  // the mirror plane covers more than this fraction of the picture
  d.press_and_move(d.vertex(v), d.vertex(v) + glm::vec2(12, 0));
  d.settle();
  CHECK(test::difference(without, d.picture(), 0) > plane);
}

TEST_CASE("at_the_start_every_vertex_of_the_dragons_cage_can_be_dragged_at_once") {
  Dragon d;
  for (std::uint32_t v = 0; v < d.pose().size(); ++v)
    CHECK_FALSE(interact::is_crowded(d.document(), d.workspace().view.camera, d.vertex(v)));
}

TEST_CASE("sets_and_hiding_work_by_keys_and_buttons") {
  Dragon d("", test::with_pixels);
  const auto selected = [&] { return d.document().selection().size(); };
  // Counts the pixels that have the colour of selected vertices.
  const auto amber = [&] {
    d.move({700, 20});
    d.frame(2);
    const render::Image picture = d.picture();
    int count = 0;
    for (int y = 0; y < picture.height - 30; ++y)
      for (int x = 330; x < picture.width - 330; ++x) {
        const auto p = picture.pixel(x, y);
        count += p[0] > 200 && p[1] > 130 && p[1] < 210 && p[2] < 90;
      }
    return count;
  };
  CHECK(amber() == 0);
  d.press_key('B');
  d.drag({400, 100}, {640, 700});
  const std::size_t few = selected();
  CHECK(few > 3);
  CHECK(few < d.pose().size());
  CHECK(d.moved().empty());
  CHECK(amber() > 50);
  d.click("save_set");
  d.press_key('A', false, true);
  CHECK(selected() == 0);
  d.click("set/0/select");
  CHECK(selected() == few);
  d.press_key('H', false, true);
  CHECK(amber() == 0);
  d.click("set/0/remove");
  CHECK(d.document().groups().sets.empty());
}

TEST_CASE("painted_vertices_stay_when_the_cage_moves") {
  Dragon d;
  d.press_key(workspace::Key::pad3);  // from the right, where the wings cover the body
  d.settle();
  const auto rest = d.document().model().surface->positions;
  d.press_key('D');
  CHECK_FALSE(workspace::gizmo_of(d.workspace()));
  const glm::vec2 middle = d.workspace().view.camera.viewport.middle();
  d.move(middle);
  const float radius = d.workspace().view.brush.radius;
  d.key(Driver::left_shift, true);
  d.wheel(3);
  d.key(Driver::left_shift, false);
  d.frame(2);
  CHECK(d.workspace().view.brush.radius > 1.2f * radius);
  d.drag(middle, middle + glm::vec2(60, 10));
  d.settle();
  const auto painted = d.document().mask();
  REQUIRE(painted);
  CHECK(std::ranges::count(*painted, 0.0f) > 20);
  pose::Pose pose = d.document().pose();
  for (auto& p : pose.positions) p[1] += 1;
  document::set_pose(d.document(), pose);
  d.settle();
  const auto moved = d.checked_positions();
  for (std::size_t v = 0; v < rest.size(); ++v)
    CHECK(std::abs(moved[v][1] - rest[v][1] - double((*painted)[v])) < 1e-12);
  d.key(Driver::left_ctrl, true);  // Ctrl erases
  d.press_and_move(middle, middle - glm::vec2(60, 10));
  d.key(Driver::left_ctrl, false);
  CHECK(d.document().mask() != painted);
  d.press_key(workspace::Key::escape);
  d.button(0, false);
  CHECK(d.document().mask() == painted);
  d.click("brush_share");  // a click in the center sets the middle value
  CHECK(d.workspace().view.brush.share == doctest::Approx(0.5).epsilon(0.1));
  d.click("mask_clear");
  CHECK_FALSE(d.document().mask());
}
