#include "scene/document/checks.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>

#include "deform/cage_state.h"
#include "mesh/triangulation.h"
#include "scene/cube.h"
#include "scene/workspace/check_view.h"

using namespace viete;
using namespace viete::scene;

namespace {

using List = std::vector<std::uint32_t>;
using Edges = std::vector<mesh::Edge>;

OpenedSurface opened(mesh::Surface surface) {
  OpenedSurface result;
  result.summary = mesh::summarize(surface);
  result.surface = std::make_shared<const mesh::Surface>(std::move(surface));
  return result;
}

std::vector<Finding> check_in(mesh::Surface cage, mesh::Surface model = test::cube(1)) {
  return check(opened(std::move(model)), opened(std::move(cage)));
}

mesh::Surface with_triangles(const mesh::Surface& s, std::vector<mesh::Triangle> triangles) {
  return mesh::from_triangles(s.positions, triangles);
}

void check_only(const std::vector<Finding>& found, Defect defect, Subject subject, ElementKind kind) {
  REQUIRE(found.size() == 1);
  CHECK(found[0].defect == defect);
  CHECK(found[0].subject == subject);
  CHECK(found[0].kind == kind);
  CHECK(!meaning(found[0]).empty());
}

// Two separate cubes, or one.
deform::Cage cage_of(int cubes) {
  mesh::Surface surface = test::cube(1);
  const auto positions = surface.positions;
  const auto triangles = surface.triangles;
  for (int i = 1; i < cubes; ++i) {
    for (auto p : positions) surface.positions.push_back({p[0] + 5 * i, p[1], p[2]});
    for (auto t : triangles) {
      for (auto& v : t) v += static_cast<std::uint32_t>(8 * i);
      surface.triangles.push_back(t);
    }
  }
  return deform::make_cage(mesh::from_triangles(surface.positions, surface.triangles));
}

// The notes about the cage with its first vertices mapped.
std::vector<std::string> notes(deform::Cage cage, std::size_t mapped, auto map) {
  deform::Pose pose = deform::rest_pose(cage);
  for (std::size_t v = 0; v < mapped; ++v) map(pose.positions[v]);
  deform::CageState state(std::make_shared<const deform::Cage>(std::move(cage)), deform::Elements::face,
                          deform::Blend::srl);
  state.set_pose(pose);
  return pose_notes(state.report(), state.cage(), pose);
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a_sound_model_in_a_sound_cage_gives_no_finding") {
  CHECK(check_in(test::cube(1.5)).empty());
  CHECK(check(opened(test::cube(1)), {}).empty());
}

TEST_CASE("an_open_cage_names_its_edges") {
  auto triangles = test::cube(1.5).triangles;
  triangles.erase(triangles.begin());
  const auto found = check_in(with_triangles(test::cube(1.5), triangles));
  check_only(found, Defect::open, Subject::cage, ElementKind::edge);
  CHECK(found[0].edges == Edges{{0, 1}, {0, 2}, {1, 2}});
  CHECK(title(found[0]) == "3 open edges");
  CHECK(first_elements(found[0], 2) == "0-1, 0-2 and 1 more");
  CHECK(matters(found[0]));
}

TEST_CASE("a_fin_names_its_edge_of_three_faces") {
  auto s = test::cube(1.5);
  auto triangles = s.triangles;
  s.positions.push_back({0, 0, -9});
  triangles.push_back({1, 2, 8});
  const auto found = check_in(with_triangles(s, triangles));
  REQUIRE(found.size() == 2);
  CHECK(found[0].edges == Edges{{1, 8}, {2, 8}});
  CHECK(found[1].defect == Defect::nonmanifold_edge);
  CHECK(found[1].edges == Edges{{1, 2}});
}

TEST_CASE("a_turned_face_names_its_edges_and_puts_nothing_outside") {
  auto s = test::cube(1.5);
  std::swap(s.triangles[4][0], s.triangles[4][1]);
  const auto found = check_in(with_triangles(s, s.triangles), test::cube(1.499));
  check_only(found, Defect::misoriented, Subject::cage, ElementKind::edge);
  CHECK(found[0].edges.size() == 3);
}

TEST_CASE("an_inside_out_cage_is_reported_as_information") {
  auto s = test::cube(1.5);
  for (auto& t : s.triangles) std::swap(t[0], t[1]);
  const auto found = check_in(with_triangles(s, s.triangles));
  check_only(found, Defect::inside_out, Subject::cage, ElementKind::face);
  CHECK(found[0].size() == 12);
  CHECK(!matters(found[0]));
}

TEST_CASE("a_face_without_area_and_a_thin_one_are_named") {
  // A vertex on an edge of the cube, or close to it, in its own faces.
  for (const double beside : {0.0, 1e-6}) {
    auto s = test::cube(1.5);
    s.positions.push_back({1.5 - beside, 0, -1.5 - beside});  // on or near the edge 1-3
    auto triangles = s.triangles;
    triangles.push_back({1, 8, 3});
    const auto found = check_in(with_triangles(s, triangles));
    const auto defect = beside > 0 ? Defect::thin : Defect::degenerate;
    const auto at =
        std::find_if(found.begin(), found.end(), [&](const auto& f) { return f.defect == defect; });
    REQUIRE(at != found.end());
    CHECK(at->elements == List{12});
  }
}

TEST_CASE("vertices_at_one_place_are_named_and_do_not_open_the_cage") {
  auto s = test::cube(1.5);
  auto triangles = s.triangles;
  s.positions.push_back(s.positions[3]);
  triangles[1][2] = 8;
  const auto found = check_in(with_triangles(s, triangles));
  check_only(found, Defect::doubled_vertex, Subject::cage, ElementKind::vertex);
  CHECK(found[0].elements == List{8});
  CHECK(title(found[0]) == "1 duplicate vertex");
}

TEST_CASE("an_unused_vertex_is_reported_as_information") {
  auto s = test::cube(1.5);
  s.positions.push_back({0, 5, 0});
  const auto found = check_in(s);
  check_only(found, Defect::unused_vertex, Subject::cage, ElementKind::vertex);
  CHECK(found[0].elements == List{8});
  CHECK(!matters(found[0]));
}

TEST_CASE("a_cage_that_cuts_itself_names_the_faces") {
  auto s = test::cube(1.5);
  s.positions[7] = {-2.5, -2.5, -2.5};  // pulled through the whole cage
  const auto found = check_in(s, test::cube(0.01));
  REQUIRE(!found.empty());
  CHECK(found[0].defect == Defect::self_intersection);
  CHECK(found[0].size() >= 4);
}

TEST_CASE("model_vertices_outside_the_cage_are_named") {
  auto model = test::cube(1);
  model.positions[2] = {-1, 1.75, -1};
  model.positions[5] = {4, 4, 4};
  const auto found = check_in(test::cube(1.5), model);
  check_only(found, Defect::vertices_outside, Subject::model, ElementKind::vertex);
  CHECK(found[0].elements == List{2, 5});
  CHECK(matters(found[0]));
}

TEST_CASE("a_cage_that_fits_when_rotated_is_reported_as_such") {
  mesh::Surface model = test::cube(1);
  for (auto& p : model.positions) p = {p[0], 2 * p[1], 4 * p[2]};
  mesh::Surface larger = model, turned = model, elsewhere = model;
  for (auto& p : larger.positions) p = 1.1 * p;
  for (auto& p : turned.positions) p = {1.1 * p[2], 1.1 * p[0], 1.1 * p[1]};
  for (auto& p : elsewhere.positions) p[0] += 10;
  const OpenedSurface opened_model = generated_surface(model, "model");
  const auto outside = [&](const mesh::Surface& cage) -> std::optional<Finding> {
    CheckState checks;
    take_findings(checks, check(opened_model, generated_surface(cage, "cage")));
    const auto at = outside_finding(checks);
    return at ? std::optional(checks.findings[*at]) : std::nullopt;
  };
  CHECK_FALSE(outside(larger));
  REQUIRE(outside(turned));
  CHECK(outside(turned)->turned);
  CHECK(meaning(*outside(turned)).ends_with("Rotated, the cage fits clearly better."));
  REQUIRE(outside(elsewhere));
  CHECK_FALSE(outside(elsewhere)->turned);
}

TEST_CASE("faces_are_polygons_and_not_their_triangles") {
  mesh::Surface s;  // a pentagon with a degenerate triangle, after a quad
  s.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}, {1.5, 1, 0}};
  s.corners = {0, 1, 2, 3, 1, 4, 5, 6, 2};
  s.polygon_starts = {0, 4, 9};
  mesh::triangulate(s);
  s.positions[5] = s.positions[4];
  const auto found = check_model(s, mesh::summarize(s));
  const auto named =
      std::find_if(found.begin(), found.end(), [](const auto& f) { return f.defect == Defect::degenerate; });
  REQUIRE(named != found.end());
  CHECK(named->elements == List{1});
  CHECK(vertices_of(*named, s, 0) == List{1, 4, 5, 6, 2});
}

TEST_CASE("important_findings_come_first") {
  auto model = test::cube(1);
  model.positions.push_back({0, 0, 0});
  model.positions[5] = {4, 4, 4};
  const auto found = check_in(test::cube(1.5), model);
  REQUIRE(found.size() == 2);
  CHECK(found[0].defect == Defect::vertices_outside);
  CHECK(found[1].defect == Defect::unused_vertex);
}

TEST_CASE("checks_can_be_cancelled") {
  base::Progress progress;
  progress.cancel();
  CHECK_THROWS_AS(check(opened(test::cube(1)), opened(test::cube(2)), &progress), base::Cancelled);
}

TEST_CASE("a_finding_is_shown_stepped_through_and_hidden") {
  auto w = test::cube_workspace();
  take_findings(w.checks, {{Defect::open, Subject::cage, ElementKind::edge, {}, {{0, 1}, {5, 7}}}});
  CHECK(shown_elements(w.checks, 10).empty());
  toggle_finding(w, 0);
  CHECK(shown_elements(w.checks, 10) == std::vector<std::size_t>{0, 1});
  CHECK(shown_elements(w.checks, 1) == std::vector<std::size_t>{0});
  CHECK(w.requests.frame_finding);
  step_element(w, 1);
  CHECK(shown_elements(w.checks, 10) == std::vector<std::size_t>{0});
  step_element(w, -1);
  CHECK(shown_elements(w.checks, 10) == std::vector<std::size_t>{1});
  frame_finding(w, w.document.pose.positions);
  CHECK(w.camera.destination().target.x > 0.2F);  // edge 5-7 is on the right
  toggle_finding(w, 0);
  CHECK(!w.checks.shown);
}

TEST_CASE("a_mirrored_cage_is_reported_as_mirrored") {
  for (int axis = 0; axis < 3; ++axis) {
    const auto said = notes(cage_of(1), 8, [&](mesh::Point& p) { p[axis] = -2 * p[axis]; });
    REQUIRE(said.size() == 1);
    CHECK_MESSAGE(holds(said[0], "The cage is mirrored in this pose"), said[0]);
  }
  const auto through_a_point = notes(cage_of(1), 8, [](mesh::Point& p) { p = {-p[0], -p[1], -p[2]}; });
  REQUIRE(through_a_point.size() == 1);
  CHECK(holds(through_a_point[0], "mirrored"));
}

TEST_CASE("a_cage_that_is_turned_stretched_or_bent_is_no_mirror_image") {
  CHECK(notes(cage_of(1), 8, [](mesh::Point& p) { p = {-p[0], -p[1], p[2]}; }).empty());
  CHECK(notes(cage_of(1), 8, [](mesh::Point& p) { p[0] *= 30; }).empty());
  const auto torn = notes(cage_of(1), 4, [](mesh::Point& p) { p = {-p[0], -p[1], p[2]}; });
  for (const auto& note : torn) CHECK_FALSE(holds(note, "mirror"));
}

TEST_CASE("mirrored_parts_are_counted") {
  const auto said = notes(cage_of(2), 8, [](mesh::Point& p) { p[1] = -p[1]; });
  REQUIRE_FALSE(said.empty());
  CHECK_MESSAGE(holds(said[0], "1 of 2 parts of the cage is mirrored"), said[0]);
}
