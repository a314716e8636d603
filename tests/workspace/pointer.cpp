#include "workspace/pointer.h"

#include <doctest/doctest.h>

#include "support/cube.h"
#include "support/edits.h"
#include "support/mouse.h"

using namespace viete;
using namespace viete::document;
using namespace viete::interact;
using namespace viete::workspace;

namespace {

struct Mouse : test::Mouse {
  Mouse() : test::Mouse(test::cube_workspace()) {}
  std::vector<std::uint32_t> selected() const { return w.document.selection().indices(); }
};

}  // namespace

TEST_CASE("hovering_finds_the_vertex_and_panels_hide_it") {
  Mouse m;
  m.move(m.vertex(3));
  CHECK(m.w.view.interaction.hovered == 3u);
  m.input.over_view = false;
  m.step();
  CHECK_FALSE(m.w.view.interaction.hovered);
}

TEST_CASE("clicks_select_shift_adds_ctrl_removes_and_empty_space_clears") {
  Mouse m;
  m.click(m.vertex(3));
  CHECK(m.selected() == std::vector<std::uint32_t>{3});
  m.input.shift = true;
  m.click(m.vertex(1));
  CHECK(m.selected() == std::vector<std::uint32_t>{1, 3});
  m.input.shift = false;
  m.input.ctrl = true;
  m.click(m.vertex(3));
  CHECK(m.selected() == std::vector<std::uint32_t>{1});
  m.input.ctrl = false;
  m.click({210, 10});
  CHECK(m.selected().empty());
}

TEST_CASE("a_dragged_vertex_follows_the_cursor_to_the_pixel_in_both_cameras") {
  for (const bool orthographic : {false, true}) {
    Mouse m;
    m.w.view.camera.set_orthographic(orthographic);
    const glm::vec2 from = m.vertex(7), to = from + glm::vec2(61, -47);
    m.drag(from, to);
    CHECK(glm::distance(m.vertex(7), to) < 0.01f);
    CHECK(m.selected() == std::vector<std::uint32_t>{7});
    CHECK(test::edit_count(m.w.document.history()) == 1);
    undo(m.w.document);
    CHECK(m.w.document.pose().positions == m.w.document.cage()->surface.positions);
  }
}

TEST_CASE("esc_or_the_right_button_during_a_drag_restores_exactly") {
  for (const bool by_escape : {true, false}) {
    Mouse m;
    m.click(m.vertex(1));
    const auto before = m.w.document.pose().positions;
    m.begin(m.vertex(7), m.vertex(7) + glm::vec2(40, 40));
    CHECK(m.w.document.pose().positions != before);
    by_escape ? m.press_escape() : m.press(right_button);
    CHECK(m.w.document.pose().positions == before);
    CHECK(m.selected() == std::vector<std::uint32_t>{1});
    m.move({500, 500});
    m.release();
    CHECK(m.w.document.pose().positions == before);
    CHECK(test::edit_count(m.w.document.history()) == 0);
  }
}

TEST_CASE("a_drag_on_empty_space_selects_a_box") {
  Mouse m;
  m.drag({205, 5}, {995, 775});
  CHECK(m.selected().size() == 8);
  CHECK_FALSE(m.w.view.interaction.box);
  m.input.ctrl = true;
  const glm::vec2 v = m.vertex(7);
  m.drag(v + glm::vec2(12, 12), v - glm::vec2(12, 12));
  CHECK(m.selected().size() == 7);
  CHECK_FALSE(differs_from_rest(m.w.document));
}

TEST_CASE("middle_right_and_alt_left_drags_orbit_shift_pans_ctrl_zooms") {
  for (const int button : {middle_button, right_button}) {
    Mouse m;
    const CameraPose before = m.w.view.camera.pose();
    m.drag({500, 300}, {560, 320}, button);
    CHECK(m.w.view.camera.pose().yaw != before.yaw);
    CHECK(m.w.view.camera.pose().distance == before.distance);
    const float yaw = m.w.view.camera.pose().yaw;
    m.input.shift = true;
    m.drag({500, 300}, {560, 320}, button);
    CHECK(m.w.view.camera.pose().yaw == yaw);
    CHECK(m.w.view.camera.pose().target != before.target);
    m.input.shift = false;
    m.input.ctrl = true;
    m.drag({500, 300}, {500, 260}, button);
    CHECK(m.w.view.camera.pose().distance < before.distance);
  }
  Mouse m;
  m.input.alt = true;
  const float yaw = m.w.view.camera.pose().yaw;
  m.drag(m.vertex(7), m.vertex(7) + glm::vec2(40, 0));
  CHECK(m.w.view.camera.pose().yaw != yaw);
  CHECK_FALSE(differs_from_rest(m.w.document));
}

TEST_CASE("a_drag_goes_on_over_panels") {
  Mouse m;
  const glm::vec2 from = m.vertex(7);
  m.begin(from, from - glm::vec2(20, 0));
  m.input.over_view = false;
  m.move({50, from.y});
  m.release();
  CHECK(m.vertex(7).x == doctest::Approx(50).epsilon(1e-3));
}

TEST_CASE("a_press_over_a_panel_or_on_a_hidden_cage_drags_nothing") {
  for (const bool panel : {true, false}) {
    Mouse m;
    m.input.over_view = !panel;
    m.w.view.options.cage = panel;
    m.drag(m.vertex(7), m.vertex(7) + glm::vec2(50, 0));
    CHECK_FALSE(differs_from_rest(m.w.document));
    CHECK(m.selected().empty());
  }
}

TEST_CASE("edges_are_hovered_clicked_and_dragged") {
  Mouse m;
  m.w.document.changed_selection() = Selection(ElementKind::edge);
  const glm::vec2 middle = 0.5f * (m.vertex(5) + m.vertex(7));
  m.move(middle);
  REQUIRE(m.w.view.interaction.hovered);
  CHECK(m.w.document.cage()->edges[*m.w.view.interaction.hovered] == mesh::Edge{5, 7});
  m.drag(middle, middle + glm::vec2(30, 10));
  CHECK(m.selected().size() == 1);
  CHECK(glm::distance(0.5f * (m.vertex(5) + m.vertex(7)), middle + glm::vec2(30, 10)) < 2);
  CHECK(m.w.document.history().undo_label() == "move an edge");
}

TEST_CASE("near_a_ring_the_ring_is_dragged_and_no_edge_that_passes_there") {
  Mouse m;
  m.w.document.changed_selection() = Selection(ElementKind::edge);
  m.w.view.tool = Tool::rotate;
  m.click(0.5f * (m.vertex(5) + m.vertex(7)));
  const std::vector<std::uint32_t> selected = m.selected();
  REQUIRE(selected.size() == 1);
  const Gizmo gizmo = *gizmo_of(m.w);
  int tried = 0;
  for (const auto& ring : gizmo.rings)
    for (const auto& point : ring) {
      const glm::vec2 outward = glm::normalize(point.at - gizmo.center);
      for (const float off : {-11.0f, 11.0f}) {
        const glm::vec2 at = point.at + off * outward;
        const auto edge = pick_element(m.w.document, m.w.view.camera, at);
        if (!point.front || pick_handle(gizmo, at) || !edge || edge->index == selected.front()) continue;
        ++tried;
        m.drag(at, at + 25.0f * glm::vec2(-outward.y, outward.x));
        CHECK(m.selected() == selected);
        CHECK(m.w.document.history().undo_label() == "rotate an edge");
        undo(m.w.document);
        m.move({1, 1});
      }
    }
  CHECK(tried > 0);
}

TEST_CASE("a_face_must_be_selected_before_it_is_dragged_and_a_drag_on_another_draws_a_box") {
  Mouse m;
  m.w.document.changed_selection() = Selection(ElementKind::face);
  m.w.view.tool = Tool::select;
  const glm::vec2 inside = (m.vertex(4) + m.vertex(5) + m.vertex(6)) / 3.0f;
  m.drag(inside, inside + glm::vec2(30, 10));
  CHECK_FALSE(differs_from_rest(m.w.document));
  m.click(inside);
  REQUIRE(m.selected().size() == 1);
  m.drag(inside, inside + glm::vec2(30, 10));
  CHECK(differs_from_rest(m.w.document));
  CHECK(m.w.document.history().undo_label() == "move a face");
}

TEST_CASE("a_handle_of_the_gizmo_is_hovered_and_used_and_a_click_on_it_keeps_the_selection") {
  Mouse m;
  m.click(m.vertex(7));
  const Gizmo gizmo = *gizmo_of(m.w);
  m.move(gizmo.arms[1].tip);
  CHECK(m.w.view.interaction.handle == Constraint{Constraint::Kind::axis, 1});
  CHECK_FALSE(m.w.view.interaction.hovered);
  m.click(gizmo.arms[1].tip);
  CHECK(m.selected() == std::vector<std::uint32_t>{7});
  m.drag(gizmo.arms[1].tip, gizmo.arms[1].tip + glm::vec2(20, -40));
  const auto& p = m.w.document.pose().positions[7];
  CHECK(p[0] == 1.5);
  CHECK(p[1] > 1.6);
  CHECK(p[2] == 1.5);
}

TEST_CASE("numbers_typed_during_a_drag_set_it_and_enter_keeps_it") {
  Mouse m;
  m.begin(m.vertex(7), m.vertex(7) + glm::vec2(20, 20));
  m.input.typed = "z.25";
  m.step();
  m.input.typed.clear();
  CHECK(m.w.document.pose().positions[7] == mesh::Point{1.5, 1.5, 1.75});
  m.input.enter = true;
  m.step();
  m.input.enter = false;
  CHECK_FALSE(m.w.view.interaction.drag);
  m.move({300, 300});
  m.release();
  CHECK(m.w.document.pose().positions[7] == mesh::Point{1.5, 1.5, 1.75});
  CHECK(test::edit_count(m.w.document.history()) == 1);
}

TEST_CASE("ctrl_pressed_while_the_mouse_rests_snaps_at_once") {
  Mouse m;
  m.begin(m.vertex(7), m.vertex(7) + glm::vec2(33, 7));
  const auto free = m.w.document.pose().positions[7];
  m.input.ctrl = true;
  m.step();
  CHECK(m.w.document.pose().positions[7] != free);
  m.input.ctrl = false;
  m.step();
  CHECK(m.w.document.pose().positions[7] == free);
}

TEST_CASE("the_axis_widget_takes_clicks_for_views_and_drags_for_orbits") {
  Mouse m;
  const AxisWidget axes = *axis_widget_of(m.w);
  m.move(axes.center);
  CHECK(m.w.view.interaction.over_axes);
  const AxisBall& ball = axes.balls.back();
  m.click(ball.at);
  m.w.view.camera.animate(1);
  CHECK(m.w.view.camera.forward()[ball.axis] == doctest::Approx(ball.positive ? -1 : 1));
  const float yaw = m.w.view.camera.pose().yaw;
  m.drag(axes.center, axes.center + glm::vec2(-50, 0));
  CHECK(m.w.view.camera.pose().yaw != yaw);
  CHECK_FALSE(m.w.view.camera.moving());
  m.w.view.options.axes = false;
  CHECK_FALSE(axis_widget_of(m.w));
}

TEST_CASE("another_kind_of_element_chosen_between_press_and_drag_ends_it") {
  Mouse m;
  m.w.document.changed_selection() = Selection(ElementKind::edge);
  const auto before = m.w.document.pose().positions;
  for (const bool dragged : {true, false}) {
    const auto last = std::uint32_t(m.w.document.cage()->edges.size() - 1);
    const auto [a, b] = m.w.document.cage()->edges[last];
    m.move(0.5f * (m.vertex(a) + m.vertex(b)));
    REQUIRE(m.w.view.interaction.hovered);
    m.press();
    select_kind(m.w.document, ElementKind::vertex);
    if (dragged) m.move(m.input.position + glm::vec2(40, 0));
    m.release();
    CHECK(m.selected().empty());
    CHECK(m.w.document.pose().positions == before);
    select_kind(m.w.document, ElementKind::edge);
  }
}

TEST_CASE("the_wheel_changes_the_soft_radius_during_a_drag") {
  Mouse m;
  m.w.view.handling.soft = {.on = true, .radius = 0.1};
  const auto moved = [&] {
    const auto &now = m.w.document.pose().positions, &rest = m.w.document.cage()->surface.positions;
    std::size_t count = 0;
    for (std::size_t v = 0; v < now.size(); ++v) count += now[v] != rest[v];
    return count;
  };
  m.begin(m.vertex(7), m.vertex(7) + glm::vec2(30, -20));
  CHECK(moved() == 1);
  for (int i = 0; i < 40; ++i) m.turn_wheel(1);
  CHECK(m.w.view.handling.soft.radius > 1);
  CHECK(moved() > 1);
  for (int i = 0; i < 60; ++i) m.turn_wheel(-1);
  CHECK(moved() == 1);
  m.release();
  CHECK(test::edit_count(m.w.document.history()) == 1);
}
