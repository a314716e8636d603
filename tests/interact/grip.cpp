#include "interact/grip.h"

#include <doctest/doctest.h>

#include "interact/transform_drag.h"
#include "support/cube.h"
#include "support/grips.h"

using namespace viete;
using namespace viete::document;
using namespace viete::interact;

namespace {

// Returns an arm of square rings at x = 0, 1, 2 ... 9. A ring has four vertices.
Document arm() {
  Document document = test::cube_document();
  std::vector<mesh::Point> points;
  for (int ring = 0; ring < 10; ++ring)
    for (const auto& [y, z] : {std::array{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      points.push_back({double(ring), double(y), double(z)});
  std::vector<mesh::Triangle> triangles = {{0, 1, 2}, {0, 2, 3}, {38, 37, 36}, {39, 38, 36}};
  for (std::uint32_t ring = 0; ring < 9; ++ring)
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t a = 4 * ring + k, b = 4 * ring + (k + 1) % 4;
      triangles.push_back({a, a + 4, b});
      triangles.push_back({b, a + 4, b + 4});
    }
  test::put_cage(document, mesh::from_triangles(points, triangles));
  return document;
}

void select(Document& document, std::uint32_t from, std::uint32_t end) {
  std::vector<std::uint32_t> all;
  for (auto v = from; v < end; ++v) all.push_back(v);
  document.changed_selection().apply(all, SelectMode::replace);
}

void check_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-12) {
  CHECK(glm::length(a - b) <= tolerance);
}

Transform quarter_about(const Grip& grip, int axis) {
  return {.axis = grip.anchor.axes[axis], .degrees = 90};
}

// Returns a strip of quads along x. The strip is folded in the middle, so that its ends are near each other.
pose::Cage hairpin() {
  std::vector<mesh::Point> points;
  std::vector<mesh::Triangle> triangles;
  for (int i = 0; i < 8; ++i) {
    const double x = i < 4 ? i : 7 - i, z = i < 4 ? 0 : 0.5;
    points.push_back({x, 0, z});
    points.push_back({x, 2, z});
  }
  for (std::uint32_t i = 0; i + 1 < 8; ++i) {
    triangles.push_back({2 * i, 2 * i + 2, 2 * i + 1});
    triangles.push_back({2 * i + 2, 2 * i + 3, 2 * i + 1});
  }
  return pose::make_cage(mesh::from_triangles(points, triangles));
}

double share_of(const std::vector<Gripped>& all, std::uint32_t v) {
  const auto found = std::ranges::find(all, v, &Gripped::vertex);
  return found == all.end() ? 0 : found->share;
}

}  // namespace

TEST_CASE("a_joint_is_the_boundary_with_the_largest_remaining_part") {
  Document document = arm();
  const Camera camera;
  select(document, 24, 40);  // rings 6 to 9
  check_near(anchor_of(document, {.pivot = Pivot::joint}, nullptr, camera).center, {6, 0, 0});
  check_near(anchor_of(document, {}, nullptr, camera).center, {7.5, 0, 0});
  select(document, 24, 32);  // rings 6 and 7; six other rings are on the left, two on the right
  check_near(anchor_of(document, {.pivot = Pivot::joint}, nullptr, camera).center, {6, 0, 0});
  select(document, 4, 12);
  check_near(anchor_of(document, {.pivot = Pivot::joint}, nullptr, camera).center, {2, 0, 0});
  select(document, 0, 40);  // the whole cage, so there is no joint
  check_near(anchor_of(document, {.pivot = Pivot::joint}, nullptr, camera).center, {4.5, 0, 0});
}

TEST_CASE("turning_a_forearm_about_its_joint_leaves_the_elbow_where_it_is") {
  Document document = arm();
  select(document, 24, 40);
  const Grip grip = grip_of(document, {.pivot = Pivot::joint}, nullptr, Camera());
  REQUIRE(transform_selection(document, Tool::rotate, grip, quarter_about(grip, 2)));
  glm::dvec3 elbow(0), tip(0);
  for (std::uint32_t k = 0; k < 4; ++k) {
    const auto &e = document.pose().positions[24 + k], &t = document.pose().positions[36 + k];
    elbow += 0.25 * glm::dvec3(e[0], e[1], e[2]);
    tip += 0.25 * glm::dvec3(t[0], t[1], t[2]);
  }
  check_near(elbow, {6, 0, 0});
  check_near(tip, {6, 3, 0});
}

TEST_CASE("the_active_element_is_what_was_clicked_last") {
  Document document = arm();
  select(document, 24, 40);
  const Camera camera;
  CHECK_FALSE(document.selection().active());
  check_near(anchor_of(document, {.pivot = Pivot::active}, nullptr, camera).center, {7.5, 0, 0});
  document.changed_selection().apply(std::array{3u}, SelectMode::add);
  CHECK(document.selection().active() == 3u);
  check_near(anchor_of(document, {.pivot = Pivot::active}, nullptr, camera).center, {0, -1, 1});
  document.changed_selection().apply(std::array{3u}, SelectMode::remove);
  CHECK_FALSE(document.selection().active());
}

TEST_CASE("a_placed_point_is_the_pivot_and_the_median_where_none_is_placed") {
  Document document = arm();
  select(document, 36, 40);
  const Handling at_origin{.pivot = Pivot::point, .point = mesh::Point{0, 0, 0}};
  check_near(anchor_of(document, at_origin, nullptr, Camera()).center, {0, 0, 0});
  check_near(anchor_of(document, {.pivot = Pivot::point}, nullptr, Camera()).center, {9, 0, 0});
}

TEST_CASE("axes_are_of_length_1_and_right_handed_whatever_is_asked_for") {
  Document document = arm();
  select(document, 24, 40);  // four rings, longest along x
  for (const Axes axes : {Axes::world, Axes::view, Axes::selection}) {
    const Anchor a = anchor_of(document, {.axes = axes}, nullptr, Camera());
    const glm::dmat3 square = glm::transpose(a.axes) * a.axes;
    for (int k = 0; k < 3; ++k) check_near(square[k], glm::dmat3(1)[k], 1e-6);
    check_near(glm::cross(a.axes[0], a.axes[1]), a.axes[2], 1e-6);
    if (axes == Axes::selection) check_near(a.axes[0], {1, 0, 0}, 1e-9);
  }
}

TEST_CASE("in_a_mirror_the_other_side_moves_as_its_image") {
  Document document = arm();
  const auto mirror = mirror_of(*document.cage(), MirrorPlane::z);
  REQUIRE(mirror->unpaired() == 0);
  document.changed_selection().apply(std::array{37u},
                                     SelectMode::replace);  // at (9, 1, -1); its partner is 38
  const Grip grip = grip_of(document, {.mirror = MirrorPlane::z}, &*mirror, Camera());
  CHECK(vertices_of(grip) == std::vector<std::uint32_t>{37, 38});
  REQUIRE(transform_selection(document, Tool::move, grip, {.shift = {0.25, 2, -0.5}}));
  CHECK(document.pose().positions[37] == mesh::Point{9.25, 3, -1.5});
  CHECK(document.pose().positions[38] == mesh::Point{9.25, 3, 1.5});
  undo(document);
  CHECK(document.pose().positions == document.cage()->surface.positions);
}

TEST_CASE("one_side_leads_if_both_are_selected") {
  Document document = arm();
  const auto mirror = mirror_of(*document.cage(), MirrorPlane::z);
  select(document, 36, 40);
  CHECK(leading_vertices(document, &*mirror).size() == 2);
  document.changed_selection().apply(std::array{36u}, SelectMode::add);  // the active vertex is at z = -1
  CHECK(leading_vertices(document, &*mirror) == std::vector<std::uint32_t>{36, 37});
  const Grip grip = grip_of(document, {}, &*mirror, Camera());
  check_near(grip.anchor.center, {9, 0, -1});
  REQUIRE(transform_selection(document, Tool::move, grip, {.shift = {0, 0, -1}}));
  for (std::uint32_t v = 36; v < 40; ++v) CHECK(std::abs(document.pose().positions[v][2]) == 2);
}

TEST_CASE("vertices_on_the_mirror_plane_stay_on_it") {
  Document document = arm();
  std::vector<mesh::Point> points = document.cage()->surface.positions;
  for (auto& p : points) p[2] = p[2] > 0 ? 0 : p[2];  // moves half of the vertices to the plane z = 0
  mesh::Surface surface = document.cage()->surface;
  surface.positions = points;
  test::put_cage(document, surface);
  const Mirror mirror{{{0, 0, 1}, 0}, [] {
                        std::vector<std::uint32_t> partners(40, Mirror::none);
                        for (std::uint32_t v = 0; v < 40; ++v) partners[v] = v % 4 >= 2 ? v : Mirror::none;
                        return partners;
                      }()};
  select(document, 36, 40);
  const Grip grip = grip_of(document, {}, &mirror, Camera());
  REQUIRE(transform_selection(document, Tool::move, grip, {.shift = {0.5, 0.5, 3}}));
  CHECK(document.pose().positions[38] == mesh::Point{9.5, 1.5, 0});
  CHECK(document.pose().positions[36] == mesh::Point{9.5, -0.5, 2});
}

TEST_CASE("soft_vertices_move_and_rotate_by_their_share") {
  Document document = arm();
  select(document, 36, 40);
  Handling handling;
  handling.soft = {.on = true, .radius = 4 / document.space().diagonal(), .curve = SoftCurve::linear};
  const Grip grip = grip_of(document, handling, nullptr, Camera());
  CHECK(grip.vertices.size() == 16);  // rings 6 to 9
  REQUIRE(transform_selection(document, Tool::move, grip, {.shift = {0, 0, 2}}));
  CHECK(document.pose().positions[36][2] == doctest::Approx(1));
  CHECK(document.pose().positions[32][2] == doctest::Approx(0.5));   // -1 + 0.75 * 2
  CHECK(document.pose().positions[24][2] == doctest::Approx(-0.5));  // -1 + 0.25 * 2
  CHECK(document.pose().positions[20][2] == -1);
  undo(document);
  const Grip turning = grip_of(document, handling, nullptr, Camera());
  REQUIRE(transform_selection(document, Tool::rotate, turning, quarter_about(turning, 0)));
  // Ring 7 rotates by 45 degrees: the point (y, z) = (-1, -1) moves to (0, -sqrt 2).
  CHECK(document.pose().positions[28][1] == doctest::Approx(0).epsilon(1e-12));
  CHECK(document.pose().positions[28][2] == doctest::Approx(-std::sqrt(2)));
}

TEST_CASE("shares_are_1_at_the_selection_0_at_the_radius_and_fall_between") {
  for (const SoftCurve curve : {SoftCurve::smooth, SoftCurve::sharp, SoftCurve::linear}) {
    CHECK(soft_share(curve, 0) == 1);
    CHECK(soft_share(curve, 1) == 0);
    CHECK(soft_share(curve, std::nan("")) == 0);
    for (double d = 0; d < 1; d += 0.125) CHECK(soft_share(curve, d) > soft_share(curve, d + 0.125));
  }
  CHECK(soft_share(SoftCurve::constant, 0.999) == 1);
  CHECK(soft_share(SoftCurve::constant, 1) == 0);
  CHECK(soft_share(SoftCurve::smooth, 0.5) == 0.5);
  CHECK(soft_share(SoftCurve::sharp, 0.5) == 0.25);
}

TEST_CASE("over_edges_the_other_end_of_a_hairpin_is_far_and_through_space_it_is_near") {
  const pose::Cage cage = hairpin();
  const std::array<std::uint32_t, 2> end{0, 1};
  SoftSelection soft{.on = true, .curve = SoftCurve::linear};
  const auto over = softened(cage, cage.surface.positions, end, soft, 2);
  CHECK(share_of(over, 0) == 1);
  CHECK(share_of(over, 2) == doctest::Approx(0.5));
  CHECK(share_of(over, 4) == 0);
  CHECK(share_of(over, 14) == 0);
  soft.distance = SoftDistance::space;
  const auto through = softened(cage, cage.surface.positions, end, soft, 2);
  CHECK(share_of(through, 14) == doctest::Approx(0.75));
  CHECK(std::ranges::is_sorted(through, {}, &Gripped::vertex));
  CHECK(softened(cage, cage.surface.positions, {}, soft, 2).empty());
}

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
