#include "interact/transform.h"

#include <doctest/doctest.h>

#include "interact/transform_drag.h"
#include "pose/cage_state.h"
#include "support/cube.h"
#include "support/edits.h"
#include "support/grips.h"

using namespace viete;
using namespace viete::document;
using namespace viete::interact;

namespace {

Document selected_cube() {
  Document document = test::cube_document();
  document.changed_selection().select_all(8);
  return document;
}

Transform turn(double degrees, glm::dvec3 axis = {0, 1, 0}) {
  return {.axis = axis, .degrees = degrees};
}

void apply(const Transform& t, const std::vector<mesh::Point>& from, std::vector<mesh::Point>& to) {
  const PointMotion motion(t);
  for (std::size_t i = 0; i < from.size(); ++i) to[i] = motion(from[i], t.pivot);
}

constexpr double degree = 3.14159265358979323846 / 180;

// Updates the whole turns of the pose, as drawing does. Returns the turn of the first element.
mesh::Vec3 drawn_turn(Document& document) {
  pose::CageState state(document.cage(), document.deformer().weighting.elements, document.deformer().blend);
  state.set_pose(document.pose());
  document.changed_pose().turns = state.report().turns;
  return document.pose().turns[0];
}

}  // namespace

TEST_CASE("whole_turns_keep_every_bit_and_quarter_turns_about_an_axis_are_exact_and_right_handed") {
  const std::vector<mesh::Point> from{{0.1, 0.2, 0.3}, {1e-9, 7e5, -0.7}};
  auto to = from;
  for (const double degrees : {0.0, 360.0, -720.0, 3600.0}) {
    Transform t = turn(degrees, glm::normalize(glm::dvec3(1, 2, 3)));
    t.pivot = {0.3, 0.1, 77};
    apply(t, from, to);
    CHECK(to == from);
  }
  const struct {
    double degrees;
    glm::dvec3 axis;
    mesh::Point image;
  } cases[] = {{90, {0, 0, 1}, {0, 1, 0}},
               {450, {0, 0, 1}, {0, 1, 0}},
               {-90, {0, 0, 1}, {0, -1, 0}},
               {180, {0, 1, 0}, {-1, 0, 0}}};
  std::vector<mesh::Point> one(1);
  for (const auto& c : cases) {
    apply(turn(c.degrees, c.axis), {{1, 0, 0}}, one);
    CHECK(one[0] == c.image);
  }
}

TEST_CASE("turns_keep_lengths_and_scales_keep_the_pivot") {
  const std::vector<mesh::Point> from{{1, 2, 3}, {4, 4, 4}};
  auto to = from;
  apply(turn(37, glm::normalize(glm::dvec3(1, -2, 0.5))), from, to);
  CHECK(mesh::norm(to[0]) == doctest::Approx(std::sqrt(14.0)).epsilon(1e-14));
  apply({.pivot = {4, 4, 4}, .factors = {2, 1, 0.5}}, from, to);
  CHECK(to[0] == mesh::Point{-2, 2, 3.5});
  CHECK(to[1] == from[1]);
}

TEST_CASE("a_whole_turn_leaves_the_cage_at_rest_but_is_an_edit_that_can_be_undone") {
  Document document = selected_cube();
  transform_selection(document, Tool::move, test::plain_grip(document), {});
  CHECK_FALSE(document.history().can_undo());
  transform_selection(document, Tool::rotate, test::plain_grip(document), turn(360));
  CHECK(document.pose().positions == document.cage()->surface.positions);
  CHECK(document.pose().turns[0][1] == doctest::Approx(360 * degree));
  CHECK(differs_from_rest(document));
  CHECK(document.history().undo_label() == "rotate 8 vertices");
  undo(document);
  CHECK_FALSE(differs_from_rest(document));
}

TEST_CASE("whole_turns_of_a_posed_cage_about_any_axis_are_counted_kept_and_taken_back") {
  const std::vector<std::vector<double>> step_lists{{360},      {90, 270}, {120, 120, 120}, {180, 180},
                                                    {200, 160}, {-360},    {1080},          {400, -40}};
  for (const glm::dvec3& axis :
       {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::normalize(glm::dvec3(1, -2, 3))}) {
    for (const auto& steps : step_lists) {
      CAPTURE(steps.front());
      Document document = selected_cube();
      for (auto& p : document.changed_pose().positions) {
        p[0] += 0.4 * p[1] - 0.3 * p[2];
        p[1] += 0.5 * p[2];
      }
      document.changed_pose().positions[3][2] += 0.7;
      const auto posed = document.pose().positions;
      const auto shown = [&] { return drawn_turn(document); };
      const mesh::Vec3 before = shown();
      double degrees = 0;
      for (const double step : steps) {
        transform_selection(document, Tool::rotate, test::plain_grip(document), turn(step, axis));
        shown();
        degrees += step;
      }
      const mesh::Vec3 turned = shown(), along{axis.x, axis.y, axis.z};
      const mesh::Vec3 expected = (degrees * degree + mesh::dot(before, along)) * along;
      CHECK(mesh::norm(turned - expected) < 1e-6);
      CHECK_FALSE(same_pose(document.pose(), {posed, {before}}));
      transform_selection(document, Tool::rotate, test::plain_grip(document), turn(-degrees, axis));
      CHECK(mesh::norm(shown() - before) < 1e-6);
      for (std::size_t i = 0; i <= steps.size(); ++i) undo(document);
      CHECK(mesh::norm(shown() - before) < 1e-12);
      redo(document);
      for (std::size_t i = 1; i < steps.size(); ++i) redo(document);
      CHECK(mesh::norm(shown() - turned) < 1e-9);
    }
  }
}

TEST_CASE("a_posed_cage_that_has_turned_keeps_its_turn_while_it_is_posed_on") {
  Document document = selected_cube();
  transform_selection(document, Tool::rotate, test::plain_grip(document), turn(360, {0, 0, 1}));
  for (int i = 0; i < 40; ++i) {
    document.changed_pose().positions[6][0] += 0.02;
    document.changed_pose().positions[1][2] -= 0.02;
    drawn_turn(document);
  }
  CHECK(mesh::norm(document.pose().turns[0] - mesh::Vec3{0, 0, 360 * degree}) < 1);
  CHECK(std::hypot(document.pose().turns[0][0], document.pose().turns[0][1]) < 1e-9);
}

TEST_CASE("absurd_amounts_neither_hang_nor_leave_the_range_of_numbers") {
  Document document = selected_cube();
  transform_selection(document, Tool::rotate, test::plain_grip(document), turn(1e15));
  CHECK(document.pose().turns[0][1] == doctest::Approx(most_degrees * degree));
  undo(document);
  Transform grow;
  grow.factors = {1e5, 1e5, 1e5};
  CHECK(transform_selection(document, Tool::scale, test::plain_grip(document), grow));
  const auto large = document.pose().positions;
  for (const double factor : {1e5, 1e300, 1e308}) {
    grow.factors = {factor, 1, factor};
    CHECK_FALSE(transform_selection(document, Tool::scale, test::plain_grip(document), grow));
    CHECK(document.pose().positions == large);
  }
  CHECK(test::edit_count(document.history()) == 1);
}

TEST_CASE("an_edit_stays_within_what_can_be_drawn_whatever_the_size_and_place_of_the_model") {
  for (const double size : {1e-30, 1.0, 1e20}) {
    Document document = selected_cube();
    for (auto& p : document.changed_pose().positions) p = {p[0] * size + 7 * size, p[1] * size, p[2] * size};
    mesh::Surface model = *document.model().surface;
    for (auto& p : model.positions) p = {p[0] * size + 7 * size, p[1] * size, p[2] * size};
    document.put_model(test::surface_without_file(std::move(model)));
    const auto before = document.pose().positions;
    Transform far;
    far.shift = {1e7 * size, 0, 0};
    CHECK_FALSE(transform_selection(document, Tool::move, test::plain_grip(document), far));
    CHECK(document.pose().positions == before);
    far.shift = {1e5 * size, 0, 0};
    CHECK(transform_selection(document, Tool::move, test::plain_grip(document), far));
    CHECK(document.pose().positions != before);
    far.shift = {-1e5 * size, 0, 0};
    CHECK(transform_selection(document, Tool::move, test::plain_grip(document), far));
  }
}

TEST_CASE("turns_add_up_to_what_a_session_can_hold_and_no_further") {
  Document document = selected_cube();
  int times = 0;
  while (times < 1000 &&
         transform_selection(document, Tool::rotate, test::plain_grip(document), turn(most_degrees)))
    ++times;
  CHECK(times > 100);
  CHECK(times < 1000);
  const auto turns = document.pose().turns;
  CHECK(std::hypot(turns[0][0], turns[0][1], turns[0][2]) <= pose::largest_turn);
  CHECK_FALSE(transform_selection(document, Tool::rotate, test::plain_grip(document), turn(most_degrees)));
  CHECK(document.pose().turns == turns);
  CHECK(transform_selection(document, Tool::rotate, test::plain_grip(document), turn(-most_degrees)));
}

TEST_CASE("turning_a_part_of_the_cage_at_once_or_slowly_gives_the_same_turns") {
  const std::vector<std::uint32_t> upper{2, 3, 6, 7};
  for (const double degrees : {170.0, 500.0, 1500.0}) {
    Document at_once = test::cube_document(), slowly = test::cube_document();
    at_once.changed_selection().apply(upper, SelectMode::replace);
    transform_selection(at_once, Tool::rotate, test::plain_grip(at_once), turn(degrees));
    slowly.changed_selection().apply(upper, SelectMode::replace);
    const DocumentState before = slowly.state();
    const Grip grip = test::plain_grip(slowly);
    for (double seen = 0; seen < degrees; seen += 10)
      place(slowly, before, grip, turn(seen + 10), seen - 30);  // a jump by 40 degrees takes several steps
    CHECK(at_once.pose().positions == slowly.pose().positions);
    for (int i = 0; i < 3; ++i)
      CHECK(at_once.pose().turns[0][i] == doctest::Approx(slowly.pose().turns[0][i]).epsilon(1e-9));
  }
}
