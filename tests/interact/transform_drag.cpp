#include "interact/transform_drag.h"

#include <doctest/doctest.h>

#include "support/cube.h"
#include "support/grips.h"

using namespace viete;
using namespace viete::document;
using namespace viete::interact;
using namespace viete::workspace;
using Kind = Constraint::Kind;
using viete::interact::number_of;
using viete::interact::NumberEntry;

namespace {

constexpr double pi = 3.14159265358979323846;

struct Drag {
  Workspace w = test::cube_workspace();
  std::optional<TransformDrag> drag;
  DragInput input;

  Drag(Tool tool, Constraint constraint, glm::vec2 from_center, bool orthographic = false) {
    w.view.camera.set_orthographic(orthographic);
    const std::uint32_t two[] = {6, 7};
    w.document.changed_selection().apply(two, SelectMode::replace);
    input.cursor = center() + from_center;
    drag.emplace(w.document, test::plain_grip(w.document), tool, constraint,
                 w.view.camera.depth(view_center()), input.cursor, w.view.camera);
  }
  glm::vec3 view_center() const {
    const glm::dvec3 c = test::selection_center(w.document);
    return w.document.space().to_view({c.x, c.y, c.z});
  }
  glm::vec2 center() const {
    return glm::vec2(CursorProjection(glm::dvec3(view_center()), w.view.camera).at());
  }
  void move(glm::vec2 by) {
    input.cursor += by;
    update();
  }
  void update() { drag->update(w.document, input, w.view.camera); }
  void type(const char* text) {
    for (; *text; ++text) drag->type(*text);
    update();
  }
  mesh::Point moved(std::uint32_t v) const {
    return w.document.pose().positions[v] - w.document.cage()->surface.positions[v];
  }
};

void go_round(Drag& d, double degrees, float radius = 100) {
  const glm::vec2 center = d.center();
  const int steps = static_cast<int>(std::abs(degrees) / 10);
  for (int i = 1; i <= steps; ++i) {
    const double a = -degrees * i / steps * pi / 180;  // negative, because y points down on screen
    d.input.cursor = center + radius * glm::vec2(std::cos(a), std::sin(a));
    d.update();
  }
}

NumberEntry typed(const char* text) {
  NumberEntry entry;
  for (; *text; ++text) entry.type(*text);
  return entry;
}

}  // namespace

TEST_CASE("updates_do_not_accumulate") {
  Drag d(Tool::move, {}, {0, 0});
  const auto rest = d.w.document.pose().positions;
  const glm::vec2 press = d.input.cursor;
  for (int i = 0; i < 1000; ++i) d.move({static_cast<float>(i % 37) - 18, static_cast<float>(i % 11) - 5});
  d.input.cursor = press;
  d.update();
  CHECK(d.w.document.pose().positions == rest);
  d.drag->commit(d.w.document);
  CHECK_FALSE(d.w.document.history().can_undo());
}

TEST_CASE("cancelling_brings_positions_turns_and_selection_back") {
  Drag d(Tool::move, {}, {0, 0});
  d.w.document.changed_pose().turns = {{1, 2, 3}};
  d.drag.emplace(d.w.document, test::plain_grip(d.w.document), Tool::rotate, Constraint{}, 1, d.input.cursor,
                 d.w.view.camera);
  const auto before = d.w.document.pose();
  d.type("77");
  CHECK(d.w.document.pose().positions != before.positions);
  d.w.document.changed_pose().turns = {{9, 9, 9}};
  d.w.document.changed_selection().clear();
  d.drag->cancel(d.w.document);
  CHECK(d.w.document.pose().positions == before.positions);
  CHECK(d.w.document.pose().turns == before.turns);
  CHECK(d.w.document.selection().size() == 2);
}

TEST_CASE("an_axis_move_goes_along_its_axis_only_and_follows_the_cursor") {
  for (const bool orthographic : {false, true})
    for (int axis = 0; axis < 3; ++axis) {
      Drag d(Tool::move, {Kind::axis, axis}, {0, 0}, orthographic);
      glm::dvec3 direction(0);
      direction[axis] = 1;
      const glm::dvec2 on_screen =
          60.0 *
          glm::normalize(CursorProjection(glm::dvec3(d.view_center()), d.w.view.camera).motion(direction));
      const glm::vec2 sideways(-on_screen.y, on_screen.x);
      const glm::vec2 expected = d.center() + glm::vec2(on_screen);
      d.move(glm::vec2(on_screen) + 0.3f * sideways);  // motion across the axis has no effect
      CHECK(glm::distance(d.center(), expected) < 0.05f);
      for (int i = 0; i < 3; ++i)
        if (i != axis) CHECK(d.moved(6)[i] == 0);
      CHECK(d.moved(6)[axis] > 0);
      CHECK(d.moved(6)[axis] == doctest::Approx(d.moved(7)[axis]));
      CHECK(d.moved(0) == mesh::Point{0, 0, 0});
    }
}

TEST_CASE("a_plane_move_stays_in_its_plane_and_under_the_cursor") {
  for (int axis = 0; axis < 3; ++axis) {
    Drag d(Tool::move, {Kind::plane, axis}, {10, 10});
    const glm::vec2 before = d.center();
    d.move({20, -15});
    CHECK(d.moved(6)[axis] == 0);
    // The point under the cursor follows exactly; the center, 14 pixels away, follows approximately.
    CHECK(glm::distance(d.center() - before, glm::vec2(20, -15)) < 2.5f);
  }
}

TEST_CASE("going_round_and_back_is_as_it_was") {
  Drag d(Tool::rotate, {Kind::axis, 1}, {100, 0});
  const auto rest = d.w.document.pose().positions;
  const glm::vec2 center = d.center();
  for (int i = -72; i <= 72; ++i) {
    const double a = (72 - std::abs(i)) * pi / 18;  // two turns forward, then two turns back
    d.input.cursor = center + 100.0f * glm::vec2(std::cos(a), std::sin(a));
    d.update();
    if (i == 0) CHECK(std::abs(d.drag->transform().degrees) == doctest::Approx(720).epsilon(1e-4));
  }
  CHECK(std::abs(d.drag->transform().degrees) < 1e-9);
  for (std::size_t v = 0; v < rest.size(); ++v)
    for (int i = 0; i < 3; ++i)
      CHECK(d.w.document.pose().positions[v][i] == doctest::Approx(rest[v][i]).epsilon(1e-12));
}

TEST_CASE("ctrl_snaps_to_15_degrees_a_tenth_of_scale_and_a_tenth_of_a_cell") {
  Drag turn(Tool::rotate, {}, {100, 0});
  turn.input.snap = true;
  go_round(turn, 50);
  CHECK(turn.drag->transform().degrees == 45);
  Drag scale(Tool::scale, {}, {0, 0});
  scale.input.snap = true;
  scale.move({28, 0});
  CHECK(scale.drag->transform().factors == glm::dvec3(1.2));
  Drag move(Tool::move, {Kind::axis, 0}, {0, 0});
  move.input.snap = true;
  move.move({37, 0});
  const double tenths = move.moved(6)[0] / (0.1 * grid_cell(move.w.document.space().diagonal()));
  CHECK(std::abs(tenths) > 1);
  CHECK(tenths == doctest::Approx(std::round(tenths)).epsilon(1e-12));
}

TEST_CASE("shift_is_a_tenth_of_the_speed_from_where_the_cursor_is") {
  Drag move(Tool::move, {}, {0, 0}), fine(Tool::move, {}, {0, 0});
  move.move({43, 10});
  fine.move({40, 0});
  fine.input.slow = true;
  fine.move({30, 100});
  for (int i = 0; i < 3; ++i) CHECK(fine.moved(6)[i] == doctest::Approx(move.moved(6)[i]).epsilon(1e-6));
  Drag turn(Tool::rotate, {}, {100, 0});
  turn.input.slow = true;
  go_round(turn, 400);
  CHECK(turn.drag->transform().degrees == doctest::Approx(40).epsilon(1e-4));
}

TEST_CASE("typed_numbers_replace_the_mouse_until_they_are_deleted") {
  Drag d(Tool::move, {}, {0, 0});
  d.move({30, 0});
  const mesh::Point by_mouse = d.moved(6);
  d.type("x0.5");
  CHECK(d.moved(6) == mesh::Point{0.5, 0, 0});
  CHECK(d.drag->readout() == "X 0.5_");
  d.move({200, 100});
  CHECK(d.moved(6) == mesh::Point{0.5, 0, 0});
  d.type("-");
  CHECK(d.moved(6) == mesh::Point{-0.5, 0, 0});
  for (int i = 0; i < 4; ++i) d.drag->backspace();
  d.move({-200, -100});
  CHECK(d.moved(6)[1] == 0);
  CHECK(d.moved(6)[0] != -0.5);
  d.type("x");  // removes the constraint
  CHECK(std::abs(d.moved(6)[0] - by_mouse[0]) < 1e-6);
}

TEST_CASE("capitals_constrain_to_the_plane_across_and_for_a_turn_mean_its_normal") {
  Drag d(Tool::scale, {}, {0, 0});
  d.type("Y2");
  CHECK(d.drag->transform().factors == glm::dvec3(2, 1, 2));
  Drag turn(Tool::rotate, {}, {100, 0});
  turn.type("Z90");
  CHECK(turn.drag->constraint() == Constraint{Kind::axis, 2});
  CHECK(turn.drag->transform().degrees == 90);
}

TEST_CASE("typed_turns_of_the_whole_cage_are_counted_in_the_pose") {
  Drag d(Tool::rotate, {}, {100, 0});
  d.drag->cancel(d.w.document);
  d.w.document.changed_selection().select_all(8);
  d.drag.emplace(d.w.document, test::plain_grip(d.w.document), Tool::rotate, Constraint{Kind::axis, 1}, 1,
                 d.input.cursor, d.w.view.camera);
  for (const char* key : {"4", "0", "0"}) d.type(key);
  CHECK(d.w.document.pose().turns[0][1] == doctest::Approx(400 * pi / 180).epsilon(1e-12));
  d.drag->type('x');  // with another axis, turns are counted from 0
  d.update();
  CHECK(d.w.document.pose().turns[0][0] == doctest::Approx(400 * pi / 180).epsilon(1e-12));
  CHECK(std::abs(d.w.document.pose().turns[0][1]) < 1e-9);
}

TEST_CASE("an_axis_scale_follows_its_handle_and_scales_nothing_else") {
  const CursorProjection projection(glm::dvec3(Drag(Tool::scale, {}, {0, 0}).view_center()),
                                    test::cube_workspace().view.camera);
  const glm::vec2 outward(glm::normalize(projection.motion({1, 0, 0})));
  Drag d(Tool::scale, {Kind::axis, 0}, 80.0f * outward);
  d.move(40.0f * outward);
  CHECK(d.drag->transform().factors.x == doctest::Approx(1.5).epsilon(1e-5));
  CHECK(d.drag->transform().factors.y == 1);
  CHECK(d.moved(7)[0] == doctest::Approx(0.75).epsilon(1e-5));
  CHECK(d.moved(6)[0] == doctest::Approx(-0.75).epsilon(1e-5));
  CHECK(d.drag->readout() == "X 1.50");
}

TEST_CASE("typed_keys_and_the_text_of_a_field_make_the_same_numbers") {
  const std::pair<const char*, double> typed_keys[] = {
      {"12.5", 12.5}, {"12,5", 12.5}, {".25", 0.25}, {"1.2.3", 1.23}, {"7.", 7}, {"90-", -90}, {"-90-", 90}};
  for (const auto& [keys, value] : typed_keys) CHECK_MESSAGE(typed(keys).value() == value, keys);
  CHECK(typed("-4").text() == "-4");
  for (const char* keys : {"", "-", "."}) CHECK_FALSE_MESSAGE(typed(keys).value(), keys);
  CHECK(typed("123456789012345678901234567890").text().size() == 15);
  const std::pair<const char*, double> texts[] = {
      {"12,5", 12.5}, {"12.5", 12.5}, {",25", 0.25}, {"+7", 7}, {"-1e-3", -1e-3}};
  for (const auto& [text, value] : texts) CHECK_MESSAGE(number_of(text) == value, text);
  for (const char* text : {"", "-", "1.234,5", "1,234.5", "12 5", "1e999", "nan", "inf", "+-3", "++3", "3x"})
    CHECK_FALSE_MESSAGE(number_of(text), text);
}

TEST_CASE("backspace_takes_back_the_last_digit_and_at_last_the_sign_and_letters_mean_nothing") {
  NumberEntry entry = typed("-45");
  CHECK_FALSE(entry.type('g'));
  entry.backspace();
  CHECK(entry.value() == -4);
  entry.backspace();
  CHECK_FALSE(entry.empty());
  for (int i = 0; i < 2; ++i) {
    entry.backspace();
    CHECK(entry.empty());
  }
}
