#include "interact/shaping.h"

#include <doctest/doctest.h>

#include "interact/placing.h"
#include "support/cube.h"
#include "support/grips.h"

using namespace viete;
using namespace viete::document;
using namespace viete::interact;

namespace {

const Shaping along_x{Shape::bend, {1, 0, 0}, {5, 0, 0}, {0, 0, 1}, {}};

Shaping as(Shape shape) {
  Shaping shaping = along_x;
  shaping.shape = shape;
  return shaping;
}

void check_point(const mesh::Point& p, const mesh::Point& q) {
  for (std::size_t i = 0; i < 3; ++i) CHECK(p[i] == doctest::Approx(q[i]).epsilon(1e-9));
}

void shape_cube(Document& document, Shape shape, double amount) {
  document.changed_selection().select_all(8);
  Grip grip = test::plain_grip(document);
  grip.shaping = shaping_of(document, shape, grip, true, Camera());
  REQUIRE(grip.shaping.shape == shape);
  Transform t;
  (is_angle(shape) ? t.degrees : t.amount) = amount;
  REQUIRE(transform_selection(document, Tool::select, grip, t));
}

}  // namespace

TEST_CASE("a_bent_bar_keeps_the_length_of_its_middle_and_ends_at_its_angle") {
  for (const double degrees : {1e-9, 30.0, 90.0, 180.0, -270.0, 720.0}) {
    double length = 0;
    mesh::Point last = shaped(along_x, degrees, {1, 0, 0});
    check_point(last, {1, 0, 0});
    for (int i = 1; i <= 4000; ++i) {
      const mesh::Point now = shaped(along_x, degrees, {1 + 4 * i / 4000.0, 0, 0});
      length += mesh::norm(now - last);
      last = now;
    }
    CHECK(length == doctest::Approx(4).epsilon(1e-5));
    const double angle = degrees / 180 * std::acos(-1.0);
    const auto end = shaped(along_x, degrees, {6, 0, 0}) - shaped(along_x, degrees, {5, 0, 0});
    check_point(end, {std::cos(angle), std::sin(angle), 0});
  }
  // A quarter circle with length 4 has the radius 8 / pi.
  const double radius = 8 / std::acos(-1.0);
  check_point(shaped(along_x, 90, {5, 0, 0}), {1 + radius, radius, 0});
  check_point(shaped(along_x, 90, {0, 3, 2}), {0, 3, 2});  // points before the fixed end do not move
}

TEST_CASE("a_twisted_bar_turns_evenly_about_its_way") {
  const Shaping twist = as(Shape::twist);
  check_point(shaped(twist, 90, {5, 1, 0}), {5, 0, 1});
  check_point(shaped(twist, 90, {3, 1, 0}), {3, std::sqrt(0.5), std::sqrt(0.5)});
  check_point(shaped(twist, 90, {7, 1, 0}), {7, 0, 1});
  check_point(shaped(twist, 90, {1, 1, 0}), {1, 1, 0});
}

TEST_CASE("a_tapered_bar_is_as_thick_as_asked_for_at_its_end") {
  const Shaping taper = as(Shape::taper);
  check_point(shaped(taper, 0.5, {5, 2, -2}), {5, 1, -1});
  check_point(shaped(taper, 3, {3, 1, 0}), {3, 2, 0});
  check_point(shaped(taper, 3, {0, 1, 0}), {0, 1, 0});
}

TEST_CASE("smoothing_a_cube_makes_it_smaller_and_relaxing_brings_it_back_to_rest") {
  Document document = test::cube_document();
  const auto rest = document.pose().positions;
  shape_cube(document, Shape::smooth, 0.5);
  CHECK(mesh::bounds(document.pose().positions).diagonal() < 0.9 * mesh::bounds(rest).diagonal());
  shape_cube(document, Shape::relax, 1);
  for (std::size_t v = 0; v < 8; ++v) check_point(document.pose().positions[v], rest[v]);
}

TEST_CASE("twisting_a_whole_cube_by_two_turns_is_undone_to_the_bit") {
  Document document = test::cube_document();
  const DocumentState before = document.state();
  shape_cube(document, Shape::twist, 720);
  CHECK(document.pose().positions != before.pose.positions);
  undo(document);
  CHECK(document.pose().positions == before.pose.positions);
  CHECK(document.pose().turns == before.pose.turns);
}

TEST_CASE("one_vertex_has_no_two_ends") {
  Document document = test::cube_document();
  document.changed_selection().select_all(1);
  const Grip grip = test::plain_grip(document);
  CHECK(shaping_of(document, Shape::bend, grip, true, Camera()).shape == Shape::none);
  CHECK(shaping_of(document, Shape::smooth, grip, true, Camera()).shape == Shape::smooth);
}

TEST_CASE("a_hinge_is_perpendicular_and_nearest_to_the_requested_axis") {
  CHECK(*hinge_near(along_x, {0, 1, 0}) == glm::dvec3(0, 1, 0));
  const glm::dvec3 oblique = *hinge_near(along_x, {3, 0, -2});
  CHECK(glm::distance(oblique, glm::dvec3(0, 0, -1)) < 1e-12);
  CHECK_FALSE(hinge_near(along_x, {-1, 0, 0}));
}
