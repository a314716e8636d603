// Tests selection with box, lasso and brush.
#include "interact/picking.h"

#include "document/elements.h"
#include "support/ball.h"
#include "support/commands.h"
#include "support/cube.h"
#include "support/mouse.h"

using namespace viete;
using namespace viete::document;
using namespace viete::interact;
using namespace viete::workspace;

namespace {

struct Hand : test::Mouse {
  using test::Mouse::Mouse;

  // Returns the vertex that is nearest to the eye.
  std::uint32_t front() const {
    std::uint32_t best = 0;
    for (std::uint32_t v = 0; v < w.document.pose().positions.size(); ++v)
      if (seen(v).z < seen(best).z) best = v;
    return best;
  }
  std::size_t selected() const { return w.document.selection().size(); }
};

constexpr glm::vec2 middle{600, 390};

}  // namespace

TEST_CASE("a_self_intersecting_line_encloses_points_by_winding_number") {
  const std::array<glm::vec2, 4> square = {{{0, 0}, {10, 0}, {10, 10}, {0, 10}}};
  CHECK(encloses(square, {5, 5}));
  CHECK_FALSE(encloses(square, {15, 5}));
  CHECK_FALSE(encloses(square, {-5, 5}));
  CHECK_FALSE(encloses(square, {5, 15}));
  const std::array<glm::vec2, 8> twice = {
      {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}, {10, 0}, {10, 10}, {0, 10}}};
  CHECK(encloses(twice, {5, 5}));
  CHECK_FALSE(encloses({}, {0, 0}));
  CHECK_FALSE(encloses(std::span(square).first(2), {5, 0}));
}

TEST_CASE("over_a_dense_cage_a_drag_draws_a_box_and_tears_nothing_out") {
  Hand hand(test::ball_workspace());
  REQUIRE(hand.w.document.pose().positions.size() == 2562);
  const glm::vec2 at = hand.vertex(hand.front());
  hand.move(at);
  CHECK(hand.w.view.interaction.hovered);
  CHECK(hand.w.view.interaction.crowded);
  hand.drag(at, at + glm::vec2(60, 60));
  CHECK_FALSE(differs_from_rest(hand.w.document));
  CHECK(hand.selected() > 8);
  const std::size_t before = hand.selected();
  hand.input.shift = true;
  hand.drag(at, at - glm::vec2(60, 60));
  CHECK(hand.selected() > before + 8);
  hand.input.shift = false;
  hand.input.ctrl = true;
  hand.begin(at - 70.0f, at + 70.0f);
  REQUIRE(hand.w.view.interaction.box);
  CHECK(hand.w.view.interaction.box->mode == SelectMode::remove);
  hand.release();
  CHECK(hand.selected() == 0);
  CHECK_FALSE(differs_from_rest(hand.w.document));
}

TEST_CASE("over_a_dense_cage_a_selected_vertex_is_dragged_and_from_near_any_is") {
  Hand hand(test::ball_workspace());
  const auto v = hand.front();
  hand.w.view.tool = Tool::select;
  hand.click(hand.vertex(v));
  REQUIRE(hand.selected() == 1);
  hand.drag(hand.vertex(v), hand.vertex(v) + glm::vec2(40, 0));
  CHECK(differs_from_rest(hand.w.document));
  undo(hand.w.document);

  Hand near(test::ball_workspace());
  near.w.document.changed_selection().apply(std::array{v}, SelectMode::replace);
  frame_selection(near.w, false);
  near.w.document.changed_selection().clear();
  near.drag(near.vertex(v), near.vertex(v) + glm::vec2(40, 0));
  CHECK(differs_from_rest(near.w.document));
}

TEST_CASE("an_armed_box_begins_on_a_vertex_and_on_the_gizmo_and_esc_puts_it_away") {
  Hand hand(test::cube_workspace());
  hand.click(hand.vertex(7));
  const glm::vec2 tip = gizmo_of(hand.w)->arms[1].tip;
  CHECK(test::run_command(hand.w, "select_box"));
  hand.move(tip);
  CHECK_FALSE(hand.w.view.interaction.handle);
  hand.drag(tip, tip + glm::vec2(30, 30));
  CHECK_FALSE(differs_from_rest(hand.w.document));
  CHECK_FALSE(hand.w.view.interaction.armed);
  CHECK(test::run_command(hand.w, "select_box"));
  CHECK(test::run_command(hand.w, "stop_selecting"));
  CHECK_FALSE(hand.w.view.interaction.armed);
  CHECK(test::run_command(hand.w, "select_box"));
  CHECK(test::run_command(hand.w, "select_box"));
  CHECK_FALSE(hand.w.view.interaction.armed);
  CHECK(test::run_command(hand.w, "select_box"));
  hand.click(hand.vertex(3));
  CHECK(hand.w.document.selection().contains(3));
  CHECK_FALSE(hand.w.view.interaction.armed);
}

TEST_CASE("a_lasso_selects_its_content_and_esc_cancels_it") {
  Hand hand(test::ball_workspace());
  const auto round = [&](float radius) {
    CHECK(test::run_command(hand.w, "select_lasso"));
    hand.move(middle + glm::vec2(radius, 0));
    hand.press();
    for (int i = 1; i <= 40; ++i) {
      const float a = 6.2f * static_cast<float>(i) / 40;
      hand.move(middle + radius * glm::vec2(std::cos(a), std::sin(a)));
    }
  };
  round(80);
  REQUIRE(hand.w.view.interaction.lasso);
  hand.press_escape();
  hand.release();
  CHECK(hand.selected() == 0);
  round(80);
  hand.release();
  CHECK_FALSE(hand.w.view.interaction.lasso);
  const Projector project(hand.w.document.space(), hand.w.view.camera);
  std::size_t inside = 0;
  for (const auto& p : hand.w.document.pose().positions)
    inside += glm::distance(glm::vec2(*project(p)), middle) < 77;
  CHECK(inside > 50);
  CHECK(hand.selected() >= inside);
  CHECK_FALSE(differs_from_rest(hand.w.document));
}

TEST_CASE("the_brush_selects_along_its_way_ctrl_removes_the_wheel_sizes_and_esc_ends") {
  Hand hand(test::ball_workspace());
  CHECK(test::run_command(hand.w, "select_brush"));
  hand.move(middle);
  const float radius = hand.w.view.interaction.select_radius;
  const CameraPose camera = hand.w.view.camera.pose();
  hand.turn_wheel(1);
  CHECK(hand.w.view.interaction.select_radius > radius);
  CHECK(hand.w.view.camera.pose() == camera);
  hand.turn_wheel(-1000);
  CHECK(hand.w.view.interaction.select_radius == least_select_radius);
  hand.w.view.interaction.select_radius = 30;

  hand.drag(middle - glm::vec2(100, 0), middle + glm::vec2(100, 0));
  const std::size_t painted = hand.selected();
  CHECK(painted > 40);
  CHECK(hand.w.view.interaction.armed == SelectShape::brush);
  hand.input.ctrl = true;
  hand.drag(middle - glm::vec2(100, 0), middle);
  CHECK(hand.selected() < painted);
  CHECK(hand.selected() > 0);
  hand.input.ctrl = false;
  const Selection before = hand.w.document.selection();
  hand.begin(middle, middle + glm::vec2(0, 100));
  CHECK(hand.w.document.selection() != before);
  CHECK_FALSE(test::run_command(hand.w, "select_none"));
  hand.press_escape();
  hand.release();
  CHECK(hand.w.document.selection() == before);
  CHECK(test::run_command(hand.w, "stop_selecting"));
  hand.w.view.tool = Tool::select;
  hand.move(hand.vertex(hand.front()));
  CHECK(hand.w.view.interaction.hovered);
  CHECK_FALSE(differs_from_rest(hand.w.document));
}

TEST_CASE("a_brush_selects_the_face_under_its_center") {
  Hand hand(test::cube_workspace());
  hand.w.document.changed_selection() = Selection(ElementKind::face);
  CHECK(test::run_command(hand.w, "select_brush"));
  hand.w.view.interaction.select_radius = 5;
  hand.click((3.0f * hand.vertex(4) + hand.vertex(5) + hand.vertex(6)) / 5.0f);
  CHECK(hand.selected() == 1);
}

TEST_CASE("visible_only_leaves_out_what_the_cage_and_the_model_hide") {
  Hand hand(test::ball_workspace());
  hand.drag({205, 5}, {995, 775});
  CHECK(hand.selected() == 2562);
  CHECK(test::run_command(hand.w, "toggle_select_visible"));
  for (const auto kind : {ElementKind::vertex, ElementKind::edge, ElementKind::face}) {
    select_kind(hand.w.document, kind);
    hand.drag({205, 5}, {995, 775});
    const double share =
        static_cast<double>(hand.selected()) / static_cast<double>(element_count(hand.w.document, kind));
    CHECK(share > 0.35);  // from nearby, less than half of a ball is visible
    CHECK(share < 0.52);
    // Does not test elements near the silhouette.
    const glm::vec3 eye = hand.w.view.camera.eye();
    for (std::uint32_t i = 0; i < element_count(hand.w.document, kind); ++i) {
      const glm::vec3 p = hand.w.document.space().to_view(element_middle(hand.w.document, kind, i));
      const float facing = glm::dot(glm::normalize(p), glm::normalize(eye - p));
      if (facing > 0.15f) CHECK(hand.w.document.selection().contains(i));
      if (facing < -0.15f) CHECK_FALSE(hand.w.document.selection().contains(i));
    }
  }
}

TEST_CASE("visible_only_a_model_in_front_hides_and_a_hidden_model_does_not") {
  Hand hand(test::cube_workspace());
  auto& cage = hand.w.document.changed_pose().positions;
  for (auto& p : cage)
    for (double& x : p) x *= 0.2;  // moves the cage into the model
  hand.w.view.options.select_visible = true;
  hand.drag({205, 5}, {995, 775});
  CHECK(hand.selected() == 0);
  hand.click(hand.vertex(7));
  CHECK(hand.selected() == 0);
  hand.w.view.options.model = false;
  hand.w.view.camera.set_orthographic(true);
  hand.drag({205, 5}, {995, 775});
  CHECK(hand.selected() == 7);  // the cage hides the eighth vertex
}
