// Gizmo, typed numbers, edges and faces, orthographic view, axis widget, with real events.
#include <cmath>

#include "deform/scheme.h"
#include "mesh/formats/write.h"
#include "program/driver.h"
#include "scene/ball.h"
#include "scene/document/edit.h"
#include "scene/document/elements.h"
#include "scene/document/pose_edit.h"
#include "scene/hand/anchor.h"
#include "scene/workspace/pointer.h"
#include "support/commands.h"
#include "support/edits.h"
#include "support/folder.h"
#include "support/grips.h"
#include "ui/panels.h"

using namespace viete;
using scene::ElementKind;
using test::Driver;
using Kind = scene::Constraint::Kind;

namespace {

struct Interaction : Driver {
  Interaction() { open_dragon(); }
  scene::Gizmo gizmo() {
    const auto gizmo = scene::gizmo_of(workspace());
    REQUIRE(gizmo);
    return *gizmo;
  }
  const std::vector<mesh::Point>& pose() { return document().pose.positions; }
  // In double; the displayed floats agree with it.
  std::vector<mesh::Point> mesh() {
    const auto exact = exact_positions();
    const auto shown = viewer().deformer()->positions();
    double largest = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(exact[i][k] - shown[i][k]));
    }
    CHECK(largest < 2e-5 * document().cage->diagonal);
    return exact;
  }
  // A point on the ring's near side, and one a little further.
  std::pair<glm::vec2, glm::vec2> on_ring(int axis, std::size_t further) {
    const auto ring = gizmo().rings[axis];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (ring[i].front && ring[(i + 5) % ring.size()].front && ring[(i + 20) % ring.size()].front) {
        return {ring[(i + 5) % ring.size()].at, ring[(i + 5 + further) % ring.size()].at};
      }
    }
    FAIL("the ring has no near side");
    return {};
  }
  void select_whole_cage() {
    press_key('A');
    press_key('E');
    frame(2);
    CHECK(document().selection.size() == pose().size());
  }
};

double distance(const mesh::Point& a, const mesh::Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

double farthest_apart(const std::vector<mesh::Point>& a, const std::vector<mesh::Point>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, distance(a[i], b[i]));
  return largest;
}

// The points rotated about a vertical line.
std::vector<mesh::Point> turned(const std::vector<mesh::Point>& points, const glm::dvec3& center,
                                double degrees) {
  const double a = degrees * 3.14159265358979323846 / 180, c = std::cos(a), s = std::sin(a);
  std::vector<mesh::Point> result;
  for (const auto& p : points) {
    const double x = p[0] - center.x, z = p[2] - center.z;
    result.push_back({center.x + c * x + s * z, p[1], center.z - s * x + c * z});
  }
  return result;
}

}  // namespace

TEST_CASE("a_ring_of_the_whole_posed_cage_tells_to_orbit_instead") {
  Interaction d;
  const auto tells = [&] {
    return ui::mouse_text(d.workspace()).find("slightly change the model's shape") != std::string::npos;
  };
  d.select_whole_cage();
  d.move(d.on_ring(1, 12).first);
  d.frame();
  CHECK_FALSE(tells());  // at rest
  deform::Pose pose = d.document().pose;
  pose.positions[0][0] += 1;
  d.workspace().document.pose = pose;
  d.move(d.on_ring(1, 12).first);
  d.frame();
  REQUIRE(d.workspace().interaction.handle);
  CHECK(tells());
  d.workspace().document.scheme = deform::entry(deform::Way::mean_value).scheme;
  CHECK_FALSE(tells());
}

TEST_CASE("the_whole_cage_turned_by_hand_twice_round_stays_rigid_and_its_turns_are_counted") {
  Interaction d;
  d.select_whole_cage();
  const auto rest = d.mesh();
  const glm::dvec3 center = test::selection_center(d.document());
  d.press_key(scene::Key::pad7);  // from above the ring about Y is a circle
  d.settle();
  const glm::vec2 middle = d.gizmo().center;
  const auto on_circle = [&](int i) {
    const double a = (45 - i * 15) * 3.14159265358979323846 / 180;  // 45 degrees: no other ring crosses there
    return middle + scene::gizmo_radius * glm::vec2(std::cos(a), std::sin(a));
  };
  d.move(on_circle(0));
  REQUIRE(d.workspace().interaction.handle == scene::Constraint{Kind::axis, 1});
  d.button(0, true);
  for (int i = 1; i <= 56; ++i) d.move(on_circle(i));
  const double degrees = d.workspace().interaction.drag->transform().degrees;
  CHECK(degrees == doctest::Approx(840).epsilon(1e-3));
  CHECK(d.workspace().interaction.drag->readout().substr(0, 4) == "Y 84");
  d.button(0, false);
  d.frame();
  CHECK(farthest_apart(d.mesh(), turned(rest, center, degrees)) < 1e-12);
  CHECK(d.document().pose.turns[0][1] ==
        doctest::Approx(degrees * 3.14159265358979323846 / 180).epsilon(1e-9));
  d.press_key('Z', true);
  CHECK(d.mesh() == rest);
  d.press_key('Z', true, true);
  CHECK(d.document().pose.turns[0][1] ==
        doctest::Approx(degrees * 3.14159265358979323846 / 180).epsilon(1e-9));
}

TEST_CASE("a_typed_move_is_constrained_by_letters_and_its_keys_run_no_commands") {
  Interaction d;
  const auto rest = d.pose();
  const auto v = d.free_vertex();
  const glm::vec2 at = glm::round(d.vertex(v));
  d.press_and_move(at, at + glm::vec2(30, 30));
  const auto axes = d.workspace().view.axes;
  d.key('X', true);  // a shortcut in other situations
  d.type("x");
  d.key('X', false);
  d.type("-0.125");
  CHECK(d.workspace().view.axes == axes);
  CHECK(d.pose()[v] == mesh::Point{rest[v][0] - 0.125, rest[v][1], rest[v][2]});
  d.press_key(scene::Key::backspace);
  CHECK(d.pose()[v][0] == rest[v][0] - 0.12);
  d.press_key(scene::Key::escape);
  d.button(0, false);
  CHECK(d.pose() == rest);
  CHECK_FALSE(d.document().history.can_undo());
}

TEST_CASE("edges_and_faces_are_selected_by_keys_clicks_and_boxes") {
  Interaction d;
  d.press_key('2');
  CHECK(d.document().selection.kind() == ElementKind::edge);
  const auto& edges = d.document().cage->edges;
  // An edge at the free vertex: clicked at a quarter of its length, where no other edge is nearer.
  const auto v = d.free_vertex();
  std::uint32_t clicked = 0;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    if (edges[e][0] == v || edges[e][1] == v) clicked = e;
  }
  const auto other = edges[clicked][0] == v ? edges[clicked][1] : edges[clicked][0];
  const glm::vec2 at = glm::mix(d.vertex(v), d.vertex(other), 0.25f);
  d.move(at);
  REQUIRE(d.workspace().interaction.hovered);
  d.click(at);
  REQUIRE(d.document().selection.size() == 1);
  CHECK(scene::selected_vertices(*d.document().cage, d.document().selection).size() == 2);
  d.press_key('3');
  CHECK(d.document().selection.kind() == ElementKind::face);
  CHECK(d.document().selection.empty());
  d.drag({330, 760}, {955, 40});
  CHECK(d.document().selection.size() == d.document().cage->surface.polygon_count());
  d.press_key('1');
  CHECK(d.document().selection.size() == d.pose().size());
  d.press_key('A', false, true);
  CHECK(d.document().selection.empty());
  d.move(d.vertex(v));
  d.press_key('L');
  CHECK(d.document().selection.size() == d.pose().size());
}

TEST_CASE("numbers_are_typed_in_the_cage_panel") {
  Interaction d;
  const auto v = d.free_vertex();
  d.click(glm::round(d.vertex(v)));
  const auto rest = d.pose();
  const auto enter = [&](const char* field, const char* number) {
    d.click(field);
    d.press_key('A', true);
    d.type(number);
    d.press_key(scene::Key::enter);
    d.frame(2);
  };
  enter("transform_y", "1.5");
  CHECK(d.pose()[v] == mesh::Point{rest[v][0], 1.5, rest[v][2]});
  CHECK(test::edit_count(d.document().history) == 1);
  d.click("transform_x");
  d.press_key(scene::Key::enter);
  CHECK_MESSAGE(test::edit_count(d.document().history) == 1, "an Enter without a change is no edit");
  d.run("undo");
  d.click("select_all");
  d.click("strip/tool_rotate");
  const auto before = d.mesh();
  const glm::dvec3 center = test::selection_center(d.document());
  enter("transform_y", "90");
  CHECK(farthest_apart(d.mesh(), turned(before, center, 90)) < 1e-12);
  d.run("undo");
  CHECK(d.pose() == rest);
}

namespace {

// Selects a vertex, and types numbers into fields without committing them.
struct TypingHand : Interaction {
  std::uint32_t vertex_selected = free_vertex();
  std::vector<mesh::Point> rest = pose();

  TypingHand() { click(glm::round(vertex(vertex_selected))); }
  void type_in(const char* field, const char* number) {
    click(field);
    press_key('A', true);
    type(number);
  }
  const mesh::Point& point() { return pose()[vertex_selected]; }
  std::size_t edits() { return test::edit_count(document().history); }
  std::string last_message() {
    const auto& all = workspace().messages.all();
    return all.empty() ? "" : all.back().text;
  }
};

}  // namespace

TEST_CASE("a_decimal_comma_is_a_point_in_the_fields_as_in_a_drag") {
  TypingHand d;
  d.type_in("transform_y", "12,5");
  d.press_key(scene::Key::enter);
  d.frame(2);
  CHECK(d.point()[1] == 12.5);
  d.type_in("transform_z", "-1,5e-1");
  d.press_key(scene::Key::enter);
  d.frame(2);
  CHECK(d.point()[2] == doctest::Approx(-0.15));
  const auto posed = d.pose();
  d.type_in("transform_x", "1.234,5");
  d.press_key(scene::Key::enter);
  d.frame(2);
  CHECK(d.pose() == posed);
  CHECK(d.last_message() == "\"1.234.5\" is not a number; nothing was changed");
}

TEST_CASE("a_field_takes_its_number_when_it_is_left_and_not_before") {
  TypingHand d;
  d.type_in("transform_y", "1.5");
  d.frame(3);
  CHECK(d.pose() == d.rest);
  SUBCASE("by a click into the next field") {
    d.click("transform_z");
    CHECK(d.point()[1] == 1.5);
  }
  SUBCASE("by a click into the field before it, which takes the keyboard first") {
    d.click("transform_x");
    CHECK(d.point()[1] == 1.5);
  }
  SUBCASE("by a click into the view, for what was selected until then") {
    d.click(glm::vec2(700, 60));
    CHECK(d.document().selection.empty());
    CHECK(d.point()[1] == 1.5);
    d.press_key('Z', true);  // restores the selection
    CHECK_FALSE(d.document().selection.empty());
    CHECK(d.point()[1] == 1.5);
    d.press_key('Z', true);
    CHECK(d.pose() == d.rest);
  }
  SUBCASE("by a click on a button") {
    d.click("strip/tool_scale");
    CHECK(d.point()[1] == 1.5);
    CHECK(d.edits() == 1);
  }
}

TEST_CASE("esc_restores_a_field") {
  TypingHand d;
  d.type_in("transform_y", "1.5");
  d.press_key(scene::Key::escape);
  d.frame(3);
  CHECK(d.pose() == d.rest);
  CHECK(d.edits() == 0);
  d.click("transform_x");
  d.press_key(scene::Key::enter);
  d.frame(2);
  CHECK(d.pose() == d.rest);
  d.type_in("transform_y", "1.5");
  d.press_key(scene::Key::f1);  // shortcuts are disabled while typing
  d.workspace().view.panels = false;
  d.frame(3);
  d.workspace().view.panels = true;
  d.frame(3);
  CHECK_MESSAGE(d.pose() == d.rest, "nor is what was typed in a field that went away");
}

TEST_CASE("a_number_that_leads_out_of_range_moves_nothing_and_says_so") {
  TypingHand d;
  for (const char* number : {"1e150", "-1e9", "1e308"}) {
    d.type_in("transform_y", number);
    d.press_key(scene::Key::enter);
    d.frame(2);
    CHECK(d.pose() == d.rest);
    CHECK(d.edits() == 0);
    CHECK(d.last_message().find("too far") != std::string::npos);
  }
  const glm::vec2 at = glm::round(d.vertex(d.vertex_selected));
  d.press_and_move(at, at + glm::vec2(30, 30));
  d.type("x");
  d.type("99999999999");
  CHECK(d.pose() == d.rest);
  CHECK(d.workspace().interaction.drag->readout() == "X 99999999999_   too far");
  for (int i = 0; i < 9; ++i) d.press_key(scene::Key::backspace);
  CHECK(d.workspace().interaction.drag->readout() == "X 99_");
  CHECK(d.point()[0] == d.rest[d.vertex_selected][0] + 99);
  d.type("999999999");
  d.press_key(scene::Key::enter);
  d.button(0, false);
  CHECK(d.pose() == d.rest);
  CHECK(d.edits() == 0);
  d.click("select_all");
  d.click("strip/tool_rotate");
  d.type_in("transform_y", "1e15");
  d.press_key(scene::Key::enter);
  d.frame(2);
  CHECK(d.last_message() == "Rotated by 360,000 degrees, the maximum at once");
}

TEST_CASE("painted_vertices_stay_until_ctrl_or_undo") {
  Interaction d;
  d.press_key(scene::Key::pad3);  // from the right, where the wings cover the body
  d.settle();
  const auto rest = d.document().model.surface->positions;
  d.press_key('D');
  CHECK(d.workspace().tool == scene::Tool::paint);
  d.frame(2);
  CHECK_FALSE(scene::gizmo_of(d.workspace()));
  const glm::vec2 middle = d.workspace().viewport.origin + 0.5f * d.workspace().viewport.size;
  const glm::vec2 to = middle + glm::vec2(60, 10);
  d.move(middle);
  d.frame(2);
  REQUIRE(d.workspace().interaction.brush);
  d.drag(middle, to);
  d.settle();
  const auto painted = d.document().mask;
  REQUIRE(painted);
  CHECK(d.document().selection.empty());  // no selection, no motion
  CHECK_FALSE(scene::differs_from_rest(d.document()));
  const auto stays = std::ranges::count(*painted, 0.0f);
  CHECK(stays > 20);

  d.press_key('W');
  d.select_whole_cage();
  deform::Pose pose = d.document().pose;
  for (auto& p : pose.positions) p[1] += 1;
  scene::set_pose(d.document(), pose);
  d.settle();
  auto moved = d.mesh();
  for (std::size_t v = 0; v < rest.size(); ++v)
    CHECK(std::abs(moved[v][1] - rest[v][1] - double((*painted)[v])) < 1e-12);
  scene::undo(d.document());
  d.settle();

  d.press_key('D');
  d.frame(2);
  d.key(Driver::left_ctrl, true);
  d.drag(middle, to);
  d.key(Driver::left_ctrl, false);
  d.settle();
  const auto after = d.document().mask;
  CHECK((!after || std::ranges::count(*after, 0.0f) < stays));
  d.press_key('Z', true);
  CHECK(d.document().mask == painted);
  d.press_key('Z', true);  // undoes the selection
  d.press_key('Z', true);
  CHECK_FALSE(d.document().mask);
  // Esc cancels a stroke.
  d.press_and_move(middle, to);
  CHECK(d.document().mask);
  d.press_key(scene::Key::escape);
  CHECK_FALSE(d.document().mask);
  d.button(0, false);
  d.frame(2);
  CHECK_FALSE(d.document().mask);
}

TEST_CASE("the_brush_is_set_in_the_panel_and_by_shift_and_wheel") {
  Interaction d;
  d.press_key('D');
  d.frame(2);
  const float radius = d.workspace().brush.radius;
  d.move(d.workspace().viewport.origin + 0.5f * d.workspace().viewport.size);
  d.key(Driver::left_shift, true);
  d.wheel(3);
  d.key(Driver::left_shift, false);
  d.frame(2);
  CHECK(d.workspace().brush.radius > 1.2f * radius);
  d.click("brush_share");  // in its center
  CHECK(d.workspace().brush.share == doctest::Approx(0.5).epsilon(0.1));
  d.click("mask_invert");
  CHECK(d.document().mask);
  d.click("mask_clear");
  CHECK_FALSE(d.document().mask);
}

TEST_CASE("a_cage_with_unpaired_vertices_offers_a_symmetric_one_that_has_none") {
  const test::TemporaryFolder folder;
  mesh::Surface cage = test::ball(1.2, 1);
  cage.positions[5][0] += 0.3;  // removes its mirror image
  mesh::write(folder / "ball.obj", test::ball(1, 3));
  mesh::write(folder / "cage.obj", cage);
  Driver d;
  REQUIRE(d.open({folder / "ball.obj", folder / "cage.obj"}));
  d.settle();
  for (const auto plane : {scene::MirrorPlane::x, scene::MirrorPlane::fit}) {
    const auto before = d.document().cage;
    d.workspace().handling.mirror = plane;
    d.frame(2);
    REQUIRE(scene::mirror_of(d.workspace())->unpaired() > 0);
    d.click("make_symmetric_cage");
    d.frame();
    d.finish_making();
    d.frame(2);
    CHECK(scene::mirror_of(d.workspace())->unpaired() == 0);
    CHECK_FALSE(scene::find_command("make_symmetric_cage")->enabled(d.workspace()));
    test::run_command(d.workspace(), "cancel_cage");
    d.frame(3);
    CHECK(d.document().cage == before);
  }
}
