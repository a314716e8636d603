#include "document/cage_editing.h"

#include "document/elements.h"
#include "document/pose_edit.h"
#include "mesh/triangle_tree.h"
#include "support/cube.h"
#include "support/edits.h"
#include "support/shapes.h"
#include "workspace/open_save.h"

using namespace viete;
using namespace viete::document;
using namespace viete::workspace;

namespace {

void select(Document& document, ElementKind kind, std::vector<std::uint32_t> indices) {
  document.changed_selection() = Selection(kind, indices);
}

double volume(const mesh::Surface& s) {
  return mesh::summarize(s).volume;
}

// Returns a document in cage editing: a cube with one posed vertex.
Document edited_cube() {
  Document document = test::cube_document();
  document.changed_pose().positions[7] = {3, 3, 3};
  begin_cage_editing(document);
  return document;
}

}  // namespace

TEST_CASE("the_mode_shows_the_cage_at_rest_and_keeps_the_pose") {
  Document document = edited_cube();
  CHECK(document.pose().positions == document.cage()->surface.positions);
  CHECK(real_pose(document).positions[7] == mesh::Point{3, 3, 3});
  end_cage_editing(document);
  CHECK_FALSE(is_editing_cage(document));
  CHECK(document.pose().positions[7] == mesh::Point{3, 3, 3});
  undo(document);
  CHECK(is_editing_cage(document));
  undo(document);
  CHECK_FALSE(is_editing_cage(document));
  CHECK(document.pose().positions[7] == mesh::Point{3, 3, 3});
}

TEST_CASE("drags_in_cage_editing_change_the_rest_shape_and_the_pose_follows") {
  Document document = edited_cube();
  const auto before = document.cage()->surface.positions;
  document.changed_history().record("move", document.state());
  document.changed_pose().positions[7] = {2, 2, 2};
  CHECK(commit_cage_edit(document));
  CHECK_FALSE(commit_cage_edit(document));
  CHECK(document.cage()->surface.positions[7] == mesh::Point{2, 2, 2});
  CHECK(document.cage_file().path.empty());
  end_cage_editing(document);
  CHECK(document.pose().positions[7] == mesh::Point{3.5, 3.5, 3.5});
  CHECK(document.pose().positions[0] == before[0]);
  while (document.history().can_undo()) undo(document);
  CHECK(document.cage()->surface.positions == before);
}

TEST_CASE("a_move_that_invalidates_the_cage_is_undone_with_a_message") {
  Document document = edited_cube();
  const auto before = document.cage()->surface.positions;
  document.changed_history().record("move", document.state());
  for (auto& p : document.changed_pose().positions) p = {0, 0, 0};
  CHECK_THROWS_AS(commit_cage_edit(document), base::Error);
  CHECK(document.cage()->surface.positions == before);
  CHECK(document.pose().positions == before);
}

TEST_CASE("splitting_and_cutting_leave_the_surface_as_it_is") {
  for (const bool edges : {true, false}) {
    CAPTURE(edges);
    Document document = edited_cube();
    const double size = volume(document.cage()->surface);
    select(document, edges ? ElementKind::edge : ElementKind::face, {0, 1, 4});
    edges ? split_selected(document) : cut_selected(document);
    CHECK(document.cage()->closed);
    CHECK(document.cage()->surface.positions.size() == 11);
    CHECK(document.cage()->element_count() == 18);
    CHECK(volume(document.cage()->surface) == doctest::Approx(size));
    CHECK(real_pose(document).positions.size() == 11);
    CHECK(real_pose(document).positions[7] == mesh::Point{3, 3, 3});
    undo(document);
    CHECK(document.cage()->element_count() == 12);
  }
}

TEST_CASE("a_new_vertex_of_a_posed_cage_lies_where_its_neighbours_are") {
  Document document = edited_cube();
  std::vector<std::uint32_t> with_seven;
  for (std::uint32_t e = 0; e < document.cage()->edges.size(); ++e)
    if (document.cage()->edges[e] == mesh::Edge{6, 7}) with_seven = {e};
  REQUIRE(with_seven.size() == 1);
  select(document, ElementKind::edge, with_seven);
  split_selected(document);
  const auto& pose = real_pose(document).positions;
  const mesh::Point middle = pose[6] + pose[7];
  for (std::size_t k = 0; k < 3; ++k) CHECK(pose[8][k] == doctest::Approx(middle[k] / 2));
}

TEST_CASE("merging_and_removing_keep_a_closed_cage_closed") {
  Document document = edited_cube();
  const auto check = [&](ElementKind kind, const std::vector<std::uint32_t>& elements,
                         void (*edit)(Document&), std::size_t vertices, std::size_t polygons,
                         std::size_t elements_after) {
    select(document, kind, elements);
    edit(document);
    CHECK(document.cage()->closed);
    CHECK(document.cage()->surface.positions.size() == vertices);
    CHECK(document.cage()->surface.polygon_count() == polygons);
    CHECK(document.cage()->element_count() == elements_after);
    undo(document);
  };
  check(ElementKind::vertex, {0, 1}, merge_selected, 7, 10, 10);
  check(ElementKind::vertex, {7}, remove_selected, 7, 10, 10);
  check(ElementKind::edge, {0}, remove_selected, 8, 11, 14);
  select(document, ElementKind::face, {0});
  remove_selected(document);
  CHECK_FALSE(document.cage()->closed);
  select(document, ElementKind::vertex, {0});
  remove_selected(document);  // the vertex is at the boundary
  CHECK(document.cage()->surface.positions.size() == 7);
  undo(document);
  undo(document);
  CHECK(document.cage()->closed);
}

TEST_CASE("extruding_selects_what_was_pushed_out_and_keeps_the_cage_closed") {
  Document document = edited_cube();
  const double size = volume(document.cage()->surface);
  select(document, ElementKind::face, {0, 1});
  extrude_selected(document);
  CHECK(document.cage()->closed);
  CHECK(document.selection().size() == 2);
  CHECK(volume(document.cage()->surface) > size);
  CHECK(document.cage()->surface.positions.size() == 12);
  undo(document);
  // All faces are extruded: each vertex moves along the normal of its own face.
  document.changed_selection().select_all(document.cage()->surface.polygon_count());
  extrude_selected(document);
  CHECK(document.cage()->closed);
  CHECK(volume(document.cage()->surface) > size);
  const auto box = mesh::used_bounds(document.cage()->surface);
  for (std::size_t k = 0; k < 3; ++k) CHECK(box.low[k] == doctest::Approx(-box.high[k]));
}

TEST_CASE("subdividing_makes_four_of_one_and_mirroring_makes_both_sides_alike") {
  Document document = edited_cube();
  const double size = volume(document.cage()->surface);
  subdivide_cage(document);
  CHECK(document.cage()->element_count() == 48);
  CHECK(volume(document.cage()->surface) == doctest::Approx(size));
  document.changed_history().record("move", document.state());
  for (auto& p : document.changed_pose().positions)
    if (p == mesh::Point{1.5, 1.5, 1.5}) p = {1.9, 1.7, 1.8};
  REQUIRE(commit_cage_edit(document));
  document.changed_selection().clear();
  mirror_cage(document);
  CHECK(document.cage()->closed);
  const auto& all = document.cage()->surface.positions;
  std::size_t axes = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    axes += std::ranges::all_of(all, [&](mesh::Point p) {
      p[k] = -p[k];
      return std::ranges::any_of(all, [&](const mesh::Point& q) { return mesh::norm(p - q) < 1e-12; });
    });
  }
  CHECK(axes >= 1);
}

TEST_CASE("a_cage_of_another_size_and_place_is_fitted_and_one_that_is_too_tight_encloses") {
  Document document = test::cube_document();
  mesh::Surface far = document.cage()->surface;
  for (auto& p : far.positions) p = {1000 + 0.01 * p[0], 0.01 * p[1], 0.01 * p[2] - 7};
  test::put_cage(document, far);
  document.changed_pose().positions[7][0] += 1;
  document.changed_pose().turns = {{0, 7, 0}};
  fit_cage(document);
  CHECK(document.pose().positions[7][0] - document.cage()->surface.positions[7][0] > 50);
  CHECK(document.pose().turns[0] == mesh::Vec3{0, 7, 0});
  CHECK(mesh::points_outside(document.cage()->surface, document.model().surface->positions).empty());
  CHECK(document.cage()->diagonal < 1.1 * document.model().bounds.diagonal());
  mesh::Surface tight = document.cage()->surface;
  tight.positions[7] = {0.5, 0.5, 0.5};
  for (const bool inside_out : {false, true}) {
    if (inside_out)
      for (auto& t : tight.triangles) std::swap(t[1], t[2]);
    tight = mesh::from_triangles(tight.positions, tight.triangles);
    test::put_cage(document, tight);
    REQUIRE_FALSE(mesh::points_outside(tight, document.model().surface->positions).empty());
    CHECK(enclose_model(document) == 0);
    CHECK(mesh::points_outside(document.cage()->surface, document.model().surface->positions).empty());
  }
}

TEST_CASE("checks_and_enclosing_judge_the_surface_that_deforms") {
  // A cube with bent quads. Any diagonals put the surface farther in or out than the centers.
  Document document(generated_surface(test::moved(test::sphere(4), 1.15), "ball"));
  mesh::Surface bent = test::cube();
  for (const std::size_t v : {0, 3, 5, 6}) bent.positions[v] = 1.6 * bent.positions[v];
  const mesh::Surface& model = *document.model().surface;
  const auto outside = [&] {
    const auto found = check_enclosure(document.cage()->surface, model);
    const auto there = mesh::points_outside(document.cage()->elements, model.positions);
    CHECK((found ? found->elements : std::vector<std::uint32_t>{}) == there);
    return there.size();
  };
  for (const auto v : {0u, 1u}) {  // both diagonals of all quads
    for (std::size_t q = 0; q < bent.polygon_count(); ++q) {
      const auto corners = std::span(bent.corners).subspan(4 * q, 4);
      while (corners[v] != 0 && corners[v] != 3 && corners[v] != 5 && corners[v] != 6)
        std::ranges::rotate(corners, corners.begin() + 1);
    }
    set_cage(document, generated_surface(bent, "bent"));
    CHECK(outside() == 0);
  }
  for (auto& p : bent.positions) p = 0.85 * p;
  set_cage(document, generated_surface(bent, "tight"));
  CHECK(outside() > 0);
  for (int edits = 0; edits < 2; ++edits) {
    CHECK(enclose_model(document) == 0);
    CHECK(outside() == 0);
    subdivide_cage(document);  // divides bent quads, which moves the surface
    outside();
  }
}

TEST_CASE("to_a_model_that_is_a_point_no_cage_is_fitted") {
  Document document(generated_surface(mesh::from_triangles({{1, 2, 3}, {1, 2, 3}}, {}), "point"));
  set_cage(document, generated_surface(test::cube(1), "cage"));
  CHECK_THROWS_AS(fit_cage(document), base::Error);
  CHECK(document.cage()->surface.positions == test::cube(1).positions);
}

TEST_CASE("an_invalid_cage_changes_nothing") {
  Document document = edited_cube();
  const auto cage = document.cage();
  const std::size_t edits = test::edit_count(document.history());
  select(document, ElementKind::vertex, {0, 1, 2, 3, 4, 5, 6, 7});
  CHECK_THROWS_AS(merge_selected(document), base::Error);
  select(document, ElementKind::vertex, {});
  CHECK_THROWS_AS(merge_selected(document), base::Error);
  CHECK_THROWS_AS(split_selected(document), base::Error);
  CHECK(document.cage() == cage);
  CHECK(test::edit_count(document.history()) == edits);
}

TEST_CASE("whole_turns_of_the_pose_outlive_an_edit_of_the_cage") {
  Document document = test::cube_document();
  document.changed_pose().turns = {{0, 6.2, 0}};
  begin_cage_editing(document);
  select(document, ElementKind::edge, {0});
  split_selected(document);
  CHECK(real_pose(document).turns == std::vector<mesh::Vec3>{{0, 6.2, 0}});
  end_cage_editing(document);
  CHECK(document.pose().turns == std::vector<mesh::Vec3>{{0, 6.2, 0}});
}

TEST_CASE("opening_a_pose_ends_cage_editing") {
  Document document = edited_cube();
  const auto cage = document.cage();
  pose::Pose pose = pose::rest_pose(*cage);
  pose.positions[0] = {-4, -4, -4};
  set_pose(document, pose);
  CHECK_FALSE(is_editing_cage(document));
  CHECK_FALSE(commit_cage_edit(document));
  CHECK(document.cage() == cage);
  CHECK(document.pose().positions == pose.positions);
}

TEST_CASE("a_file_that_now_holds_another_cage_is_not_that_of_earlier_ones") {
  const test::TemporaryFolder folder;
  Workspace w = test::cube_workspace();
  Document& document = w.document;
  document.put_saved_cage(folder / "cage.obj");
  subdivide_cage(document);
  REQUIRE(save_cage(w, folder / "cage.obj"));
  CHECK(document.cage_file().path == folder / "cage.obj");
  undo(document);
  CHECK(document.cage_file().path.empty());
  redo(document);
  CHECK(document.cage_file().path == folder / "cage.obj");
}
