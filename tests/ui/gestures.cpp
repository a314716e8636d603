// Typed numbers, the pivot, keys during drags, bending and moves of the Blender keymap, without the model.
#include <cmath>

#include "interact/gizmo.h"
#include "pose/deformer.h"
#include "support/distance.h"
#include "ui/panel_driver.h"

using namespace viete;
using test::PanelDriver;

TEST_CASE("a_ring_of_the_whole_posed_cage_advises_to_orbit_instead") {
  PanelDriver d;
  const auto advises = [&] {
    d.move({1, 1});
    d.move(workspace::gizmo_of(d.workspace())->center + glm::vec2(interact::gizmo_view_ring, 0));
    d.frame();
    REQUIRE(d.workspace().view.interaction.handle);
    return ui::mouse_text(d.workspace()).find("changes the model's shape slightly") != std::string::npos;
  };
  d.select_whole_cage();
  CHECK_FALSE(advises());  // the cage is at rest
  d.document().changed_pose().positions[0][0] += 1;
  CHECK(advises());
  d.document().put_deformer(pose::deformer_of(pose::Preset::mean_value));
  CHECK_FALSE(advises());
}

TEST_CASE("keys_typed_during_a_drag_run_no_commands") {
  PanelDriver d;
  const auto v = d.free_vertex();
  const glm::vec2 at = glm::round(d.vertex(v));
  d.press_and_move(at, at + glm::vec2(30, 30));
  const auto axes = d.workspace().view.options.axes;
  d.key('X', true);  // if no drag is active, X is a shortcut
  d.type("x");
  d.key('X', false);
  CHECK(d.workspace().view.options.axes == axes);
  d.press_key(workspace::Key::escape);
  d.button(0, false);
  CHECK(d.moved().empty());
}

TEST_CASE("a_field_applies_its_number_when_it_is_left_and_not_before") {
  PanelDriver d;
  const auto v = d.free_vertex();
  d.click(glm::round(d.vertex(v)));
  d.type_in("transform_y", "1.5");
  d.frame(3);
  CHECK(d.moved().empty());
  d.click("transform_x");  // the field before transform_y
  CHECK(d.pose()[v][1] == 1.5);
  d.type_in("transform_y", "2");
  d.click(glm::vec2(700, 60));
  CHECK(d.document().selection().empty());
  CHECK(d.pose()[v][1] == 2);  // the vertex that was selected before the click
  d.press_key('Z', true);      // restores the selection
  CHECK_FALSE(d.document().selection().empty());
  CHECK(d.pose()[v][1] == 2);
  d.press_key('Z', true);
  CHECK(d.pose()[v][1] == 1.5);
  d.type_in("transform_y", "9");
  for (const bool panels : {false, true}) {
    d.workspace().view.options.panels = panels;
    d.frame(3);
  }
  CHECK_MESSAGE(d.pose()[v][1] == 1.5, "a hidden field applies nothing");
  d.type_in("transform_y", "3");
  d.click("strip/tool_scale");
  CHECK(d.pose()[v][1] == 3);
  CHECK(d.edits() == 2);
}

TEST_CASE("a_click_places_the_pivot_snapped_to_a_vertex_and_esc_cancels") {
  PanelDriver d;
  const auto v = d.free_vertex();
  d.press_key('J');
  d.press_key(workspace::Key::escape);
  CHECK_FALSE(d.workspace().view.interaction.placing_pivot);
  CHECK(d.workspace().view.handling.pivot == document::Pivot::median);
  d.press_key('J');
  CHECK(d.workspace().view.interaction.placing_pivot);
  d.click(d.vertex(v) + glm::vec2(3, 2));
  CHECK_FALSE(d.workspace().view.interaction.placing_pivot);
  CHECK(d.workspace().view.handling.pivot == document::Pivot::point);
  CHECK(d.workspace().view.handling.point == d.pose()[v]);
  CHECK(d.document().selection().empty());
  d.select_whole_cage();
  d.enter("transform_y", "90");
  CHECK(d.pose()[v] == d.rest()[v]);
  const mesh::Point& pivot = d.rest()[v];
  const auto on_axis = std::ranges::count_if(
      d.rest(), [&](const mesh::Point& p) { return p[0] == pivot[0] && p[2] == pivot[2]; });
  CHECK(d.moved().size() + static_cast<std::size_t>(on_axis) == d.pose().size());
}

TEST_CASE("with_the_blender_keymap_g_moves_without_a_button_and_a_click_applies_the_move") {
  PanelDriver d;
  d.run("keys_blender");
  const auto v = d.free_vertex();
  d.click(d.vertex(v));
  d.move(d.vertex(v) + glm::vec2(60, 60));
  d.press_key('G');
  REQUIRE(d.workspace().view.interaction.drag);
  d.move(d.vertex(v) + glm::vec2(90, 50));
  CHECK(d.moved() == std::vector<std::uint32_t>{v});
  d.type("x");
  d.type("2");
  const auto is_applied = [&] { return std::abs(d.pose()[v][0] - d.rest()[v][0] - 2) < 1e-9; };
  CHECK(is_applied());
  CHECK(d.pose()[v][1] == d.rest()[v][1]);
  d.click(d.vertex(v) + glm::vec2(90, 50));
  CHECK_FALSE(d.workspace().view.interaction.drag);
  CHECK(is_applied());
  CHECK(d.edits() == 1);
  d.press_key('G');
  d.move({800, 300});
  d.button(1, true);
  d.button(1, false);
  CHECK_FALSE(d.workspace().view.interaction.drag);
  CHECK(is_applied());
  CHECK(d.edits() == 1);
}

TEST_CASE("bending_starts_in_the_view_and_an_axis_key_sets_its_axis") {
  PanelDriver d;
  d.press_key('A');
  d.click("bend");
  CHECK_FALSE(d.workspace().view.interaction.drag);
  d.move({700, 300});
  d.frame();
  REQUIRE(d.workspace().view.interaction.drag);
  const interact::Shaping seen = d.workspace().view.interaction.drag->grip().shaping;
  const auto is_bent = [&](std::optional<glm::dvec3> axis, double degrees) {
    interact::Shaping shaping = seen;
    if (axis) shaping.hinge = *interact::hinge_near(seen, *axis);
    std::vector<mesh::Point> expected = d.rest();
    for (auto& p : expected) p = interact::shaped(shaping, degrees, p);
    return test::largest_distance(d.pose(), expected) < 1e-9 * d.document().space().diagonal();
  };
  d.move({760, 300});
  d.type("y");
  CHECK(d.workspace().view.interaction.drag->readout() == "Bend Y 30.0\u00b0");
  CHECK(is_bent(glm::dvec3(0, 1, 0), 30));
  d.type("60");
  CHECK(is_bent(glm::dvec3(0, 1, 0), 60));
  d.type("y");  // the second y bends in the plane of the view again
  CHECK(is_bent({}, 60));
  d.type("Z");
  d.press_key(workspace::Key::enter);
  CHECK_FALSE(d.workspace().view.interaction.drag);
  CHECK(is_bent(glm::dvec3(0, 0, 1), 60));
  CHECK(d.edits() == 1);
}
