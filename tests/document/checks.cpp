#include "document/checks.h"

#include "pose/cage_state.h"
#include "support/cube.h"
#include "support/shapes.h"
#include "support/text.h"

using namespace viete;
using namespace viete::document;
using namespace viete::workspace;

namespace {

using List = std::vector<std::uint32_t>;
using Edges = std::vector<mesh::Edge>;

OpenedSurface opened(mesh::Surface surface) {
  return generated_surface(std::move(surface), "");
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

pose::Cage cage_of(int cubes) {
  mesh::Surface surface = test::cube(1);
  for (int i = 1; i < cubes; ++i) {
    mesh::Surface other = test::cube(1);
    for (auto& p : other.positions) p[0] += 5 * i;
    surface = test::both(surface, other);
  }
  return pose::make_cage(surface);
}

// Returns the messages about a pose: `map` is applied to the first `mapped` vertices.
std::vector<std::string> notes(pose::Cage cage, std::size_t mapped, auto map) {
  pose::Pose pose = pose::rest_pose(cage);
  for (std::size_t v = 0; v < mapped; ++v) map(pose.positions[v]);
  pose::CageState state(std::make_shared<const pose::Cage>(std::move(cage)), pose::Elements::face,
                        pose::Blend::srl);
  state.set_pose(pose);
  return pose_notes(state.report(), state.cage(), pose);
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

TEST_CASE("a_face_without_area_and_a_thin_one_are_named") {
  for (const double beside : {0.0, 1e-6}) {
    auto s = test::cube(1.5);
    s.positions.push_back({1.5 - beside, 0, -1.5 - beside});  // on the edge 1-3, or near this edge
    auto triangles = s.triangles;
    triangles.push_back({1, 8, 3});
    const auto found = check_in(with_triangles(s, triangles));
    const auto defect = beside > 0 ? Defect::thin : Defect::degenerate;
    const auto at = std::ranges::find(found, defect, &Finding::defect);
    REQUIRE(at != found.end());
    CHECK(at->elements == List{12});
  }
}

TEST_CASE("each_defect_is_named_with_its_elements_and_its_weight") {
  const mesh::Surface whole = test::cube(1.5);
  mesh::Surface inside_out = whole, doubled = whole, unused = whole, model = test::cube(1);
  for (auto& t : inside_out.triangles) std::swap(t[0], t[1]);
  inside_out = with_triangles(whole, inside_out.triangles);
  doubled.positions.push_back(doubled.positions[3]);
  doubled.triangles[1][2] = 8;
  doubled = with_triangles(doubled, doubled.triangles);
  unused.positions.push_back({0, 5, 0});
  model.positions[2] = {-1, 1.75, -1};
  model.positions[5] = {4, 4, 4};
  const struct {
    std::vector<Finding> found;
    Defect defect;
    Subject subject;
    ElementKind kind;
    List elements;
    bool matters;
  } cases[] = {
      {check_in(inside_out),
       Defect::inside_out,
       Subject::cage,
       ElementKind::face,
       {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11},
       false},
      {check_in(doubled), Defect::doubled_vertex, Subject::cage, ElementKind::vertex, {8}, true},
      {check_in(unused), Defect::unused_vertex, Subject::cage, ElementKind::vertex, {8}, false},
      {check_in(whole, model), Defect::vertices_outside, Subject::model, ElementKind::vertex, {2, 5}, true}};
  for (const auto& c : cases) {
    check_only(c.found, c.defect, c.subject, c.kind);
    CHECK(c.found[0].elements == c.elements);
    CHECK(matters(c.found[0]) == c.matters);
  }
  CHECK(title(cases[1].found[0]) == "1 duplicate vertex");
}

TEST_CASE("a_cage_that_cuts_itself_names_the_faces") {
  auto s = test::cube(1.5);
  s.positions[7] = {-2.5, -2.5, -2.5};  // on the other side of the cage
  const auto found = check_in(s, test::cube(0.01));
  REQUIRE(!found.empty());
  CHECK(found[0].defect == Defect::self_intersection);
  CHECK(found[0].size() >= 4);
}

TEST_CASE("faces_are_polygons_and_not_their_triangles") {
  mesh::Surface s;  // a quad, and a pentagon that contains a degenerate triangle
  s.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}, {1.5, 1, 0}};
  s.corners = {0, 1, 2, 3, 1, 4, 5, 6, 2};
  s.polygon_starts = {0, 4, 9};
  mesh::triangulate(s);
  const auto flat_faces = [&] {
    auto found = check_model(s, mesh::summarize(s));
    std::erase_if(found, [](const Finding& f) { return f.defect != Defect::degenerate; });
    return found;
  };
  s.positions[5] = s.positions[4];
  CHECK(flat_faces().empty());
  for (const std::size_t v : {4, 5, 6}) s.positions[v][0] = 1;
  const auto found = flat_faces();
  REQUIRE(found.size() == 1);
  const auto named = found.begin();
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

TEST_CASE("a_repeated_face_is_named_and_does_not_matter") {
  auto triangles = test::cube(1.5).triangles;
  triangles.push_back({triangles[4][1], triangles[4][2], triangles[4][0]});
  const auto found = check_in(with_triangles(test::cube(1.5), triangles));
  const auto at = std::ranges::find(found, Defect::repeated_face, &Finding::defect);
  REQUIRE(at != found.end());
  CHECK(at->elements == List{12});
  CHECK_FALSE(matters(*at));
  CHECK(found.size() == 1);  // its edges are not edges with more than two faces
}

TEST_CASE("points_have_no_findings_about_faces") {
  mesh::Surface points;
  points.positions = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}};
  CHECK(check_model(points, mesh::summarize(points)).empty());
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
  CHECK(w.jobs.wishes.find<workspace::FrameFinding>());
  step_element(w, 1);
  CHECK(shown_elements(w.checks, 10) == std::vector<std::size_t>{0});
  step_element(w, -1);
  CHECK(shown_elements(w.checks, 10) == std::vector<std::size_t>{1});
  frame_finding(w);
  CHECK(w.view.camera.destination().target.x > 0.2F);
  toggle_finding(w, 0);
  CHECK(!w.checks.shown);
}

TEST_CASE("mirrored_cages_and_parts_are_reported_and_turned_stretched_or_torn_ones_are_not") {
  const auto is_mirrored = [](auto map) {
    const auto said = notes(cage_of(1), 8, map);
    return said.size() == 1 && test::mentions(said[0], "The cage is mirrored in this pose");
  };
  for (int axis = 0; axis < 3; ++axis) CHECK(is_mirrored([&](mesh::Point& p) { p[axis] = -2 * p[axis]; }));
  CHECK(is_mirrored([](mesh::Point& p) { p = {-p[0], -p[1], -p[2]}; }));
  CHECK(notes(cage_of(1), 8, [](mesh::Point& p) { p = {-p[0], -p[1], p[2]}; }).empty());
  CHECK(notes(cage_of(1), 8, [](mesh::Point& p) { p[0] *= 30; }).empty());
  const auto torn = notes(cage_of(1), 4, [](mesh::Point& p) { p = {-p[0], -p[1], p[2]}; });
  for (const auto& note : torn) CHECK_FALSE(test::mentions(note, "mirror"));
  const auto said = notes(cage_of(2), 8, [](mesh::Point& p) { p[1] = -p[1]; });
  REQUIRE_FALSE(said.empty());
  CHECK_MESSAGE(test::mentions(said[0], "1 of 2 parts of the cage is mirrored"), said[0]);
}
