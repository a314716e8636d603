#include "document/selection.h"

#include <doctest/doctest.h>

#include "document/elements.h"
#include "interact/transform_drag.h"
#include "support/commands.h"
#include "support/cube.h"
#include "support/edits.h"
#include "support/grips.h"
#include "support/mouse.h"
#include "workspace/open_save.h"

using namespace viete;
using namespace viete::document;
using namespace viete::interact;
using namespace viete::workspace;
using Indices = std::vector<std::uint32_t>;

namespace {

Selection vertices(Indices indices) {
  return Selection(ElementKind::vertex, indices);
}

Workspace saved_cube() {
  Workspace w = test::cube_workspace();
  mark_saved(w);
  return w;
}

}  // namespace

TEST_CASE("selecting_is_undone_and_redone_and_is_no_work_that_could_be_lost") {
  Workspace w = saved_cube();
  const unsigned long edits = w.document.history().revision();
  CHECK(test::run_command(w, "select_all"));
  set_selection(w.document, vertices({1, 2}));
  set_selection(w.document, vertices({1, 2}));
  CHECK_FALSE(has_unsaved_edits(w));
  CHECK(w.document.history().revision() == edits);
  CHECK(w.document.history().undo_label() == "select");
  CHECK(test::edit_count(w.document.history()) == 0);
  CHECK(test::run_command(w, "undo"));
  CHECK(w.document.selection().size() == 8);
  CHECK(test::run_command(w, "undo"));
  CHECK(w.document.selection().empty());
  CHECK_FALSE(test::run_command(w, "undo"));
  CHECK(test::run_command(w, "select_faces"));  // is not an edit, because no element is selected
  CHECK_FALSE(w.document.history().can_undo());
  CHECK(test::run_command(w, "redo"));
  CHECK(test::run_command(w, "redo"));
  CHECK(w.document.selection() == vertices({1, 2}));
  CHECK_FALSE(has_unsaved_edits(w));
}

TEST_CASE("a_vertex_that_is_pulled_out_is_selected_and_moved_by_one_edit") {
  test::Mouse mouse(saved_cube());
  Workspace& w = mouse.w;
  set_selection(w.document, vertices({1}));
  w.view.tool = Tool::select;
  const glm::vec2 from = mouse.vertex(7);
  mouse.drag(from, from + 30.0f);
  CHECK(w.document.selection() == vertices({7}));
  CHECK(differs_from_rest(w.document));
  undo(w.document);
  CHECK(w.document.selection() == vertices({1}));
  CHECK_FALSE(differs_from_rest(w.document));
  redo(w.document);
  CHECK(w.document.selection() == vertices({7}));
  undo(w.document);
  // Drags a vertex and returns it to its place. Only the selection changes.
  mouse.begin(from, from + 30.0f);
  mouse.move(from);
  mouse.release();
  CHECK(w.document.selection() == vertices({7}));
  CHECK(w.document.history().undo_label() == "select");
  undo(w.document);
  CHECK(w.document.selection() == vertices({1}));
}

TEST_CASE("hidden_elements_are_not_selected_picked_or_moved") {
  Workspace w = saved_cube();
  auto& view = w.view;
  const glm::vec2 at(*Projector(w.document.space(), view.camera)(w.document.pose().positions[7]));
  set_selection(w.document, vertices({6, 7}));
  CHECK(test::run_command(w, "hide_selected"));
  CHECK(w.document.selection().empty());
  const auto under = pick_element(w.document, view.camera, at);
  CHECK((!under || under->index != 7));
  CHECK(test::run_command(w, "select_all"));
  CHECK(w.document.selection().indices() == Indices{0, 1, 2, 3, 4, 5});
  CHECK(pick_elements_in_box(w.document, view.camera, {0, 0}, {1000, 800}).size() == 6);
  CHECK(test::run_command(w, "invert_selection"));
  CHECK(w.document.selection().empty());
  // Selects and moves a face with a hidden corner. The corner does not move.
  CHECK(test::run_command(w, "select_faces"));
  CHECK(test::run_command(w, "select_all"));
  CHECK(w.document.selection().size() == 12);
  CHECK(transform_selection(w.document, Tool::move, test::plain_grip(w.document), {.shift = {1, 0, 0}}));
  CHECK(w.document.pose().positions[7] == w.document.cage()->surface.positions[7]);
  CHECK(w.document.pose().positions[5] != w.document.cage()->surface.positions[5]);
  CHECK(test::run_command(w, "show_hidden"));
  CHECK_FALSE(test::run_command(w, "show_hidden"));
  while (w.document.history().can_undo()) undo(w.document);
  CHECK(w.document.groups().hidden.empty());
  CHECK_FALSE(differs_from_rest(w.document));
}

TEST_CASE("only_these_hides_the_others_and_edges_between_hidden_vertices_are_hidden") {
  Workspace w = saved_cube();
  set_selection(w.document, vertices({0, 1}));
  CHECK(test::run_command(w, "hide_others"));
  CHECK(w.document.groups().hidden == Indices{2, 3, 4, 5, 6, 7});
  CHECK(w.document.selection() == vertices({0, 1}));
  const auto hidden = hidden_elements(w.document, ElementKind::edge);
  for (std::uint32_t e = 0; e < hidden.size(); ++e) {
    const auto& [a, b] = w.document.cage()->edges[e];
    CHECK(hidden[e] == (a > 1 && b > 1));
  }
}

TEST_CASE("sets_are_kept_renamed_selected_added_taken_out_and_deleted") {
  Workspace w = saved_cube();
  CHECK_FALSE(test::run_command(w, "save_set"));
  set_selection(w.document, vertices({0, 1, 2, 3}));
  CHECK(test::run_command(w, "save_set"));
  CHECK(has_unsaved_edits(w));
  set_selection(w.document, vertices({3, 4}));
  CHECK(test::run_command(w, "save_set"));
  REQUIRE(w.document.groups().sets.size() == 2);
  CHECK(w.document.groups().sets[1].name == "Set 2");
  rename_set(w.document, 1, "Arm");
  CHECK(w.document.groups().sets[1].name == "Arm");
  rename_set(w.document, 1, "");
  rename_set(w.document, 1, "Set 1");
  CHECK(w.document.groups().sets[1].name == "Arm");
  select_set(w.document, 0, SelectMode::replace);
  CHECK(w.document.selection() == vertices({0, 1, 2, 3}));
  select_set(w.document, 1, SelectMode::remove);
  CHECK(w.document.selection() == vertices({0, 1, 2}));
  select_set(w.document, 1, SelectMode::add);
  CHECK(w.document.selection() == vertices({0, 1, 2, 3, 4}));
  CHECK(test::run_command(w, "select_probes"));
  select_set(w.document, 1, SelectMode::add);
  CHECK(w.document.selection() == vertices({3, 4}));
  remove_set(w.document, 0);
  CHECK(w.document.groups().sets.size() == 1);
  undo(w.document);
  CHECK(w.document.groups().sets[0].name == "Set 1");
}

TEST_CASE("sets_go_with_their_vertices_through_edits_of_the_cage_and_lost_ones_are_named") {
  Workspace w = saved_cube();
  set_selection(w.document, vertices({7}));
  CHECK(test::run_command(w, "save_set"));
  set_selection(w.document, vertices({4, 5, 6, 7}));
  CHECK(test::run_command(w, "save_set"));
  CHECK(test::run_command(w, "edit_cage"));
  set_selection(w.document, vertices({7}));
  CHECK(test::run_command(w, "remove_elements"));
  REQUIRE(w.document.groups().sets.size() == 1);
  CHECK(w.document.groups().sets[0].vertices == Indices{4, 5, 6});
  REQUIRE_FALSE(w.messages.all().empty());
  CHECK(w.messages.all().back().text.find("\"Set 1\"") != std::string::npos);
  // Adds a vertex between two vertices of a set. The new vertex is in the set.
  select_set(w.document, 0, SelectMode::replace);
  CHECK(test::run_command(w, "split_edges"));
  CHECK(w.document.groups().sets[0].vertices.size() > 3);
  for (int n = 0; n < 3; ++n) CHECK(test::run_command(w, "undo"));
  CHECK(w.document.groups().sets.size() == 2);
}

TEST_CASE("modes_replace_add_and_remove_and_inverting_twice_changes_nothing") {
  Selection s = vertices({2, 5});
  s.apply(Indices{1, 5, 9}, SelectMode::add);
  CHECK(s.indices() == Indices{1, 2, 5, 9});
  s.apply(Indices{2, 3}, SelectMode::remove);
  CHECK(s.indices() == Indices{1, 5, 9});
  s.invert(10);
  CHECK(s.indices() == Indices{0, 2, 3, 4, 6, 7, 8});
  CHECK(s.contains(4));
  CHECK_FALSE(s.contains(5));
  s.invert(10);
  CHECK(s.indices() == Indices{1, 5, 9});
  s.select_all(0);
  CHECK(s.empty());
}

namespace {

mesh::Surface plane_of_quads(std::uint32_t n) {
  mesh::Surface s;
  s.polygon_starts = {0};
  for (std::uint32_t y = 0; y <= n; ++y)
    for (std::uint32_t x = 0; x <= n; ++x) s.positions.push_back({1.0 * x, 1.0 * y, 0.1 * (x == 0)});
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t v = y * (n + 1) + x;
      for (const auto corner : {v, v + 1, v + n + 2, v + n + 1}) s.corners.push_back(corner);
      s.polygon_starts.push_back(static_cast<std::uint32_t>(s.corners.size()));
    }
  mesh::triangulate(s);
  return s;
}

Selection some(ElementKind kind, const Indices& indices) {
  return Selection(kind, indices);
}

constexpr ElementKind kinds_of_cages[] = {ElementKind::vertex, ElementKind::edge, ElementKind::face};

// Returns a cage of two separate quads. One vertex is unused.
pose::Cage two_quads() {
  mesh::Surface surface;
  for (int i = 0; i < 9; ++i)
    surface.positions.push_back({double(i % 4 % 3), double(i % 4 / 2), double(i / 4)});
  surface.corners = {0, 1, 3, 2, 4, 5, 7, 6};
  surface.polygon_starts = {0, 4, 8};
  mesh::triangulate(surface);
  return pose::make_cage(surface);
}

}  // namespace

TEST_CASE("growing_adds_what_is_next_to_it_and_shrinking_takes_it_away_again") {
  const auto cage = pose::make_cage(plane_of_quads(6));
  CHECK(grown(cage, some(ElementKind::vertex, {24})).indices() == Indices{17, 23, 24, 25, 31});
  CHECK(grown(cage, some(ElementKind::face, {14})).indices() == Indices{7, 8, 9, 13, 14, 15, 19, 20, 21});
  CHECK(shrunk(cage, some(ElementKind::vertex, {17, 23, 24, 25, 31})).indices() == Indices{24});
  CHECK(shrunk(cage, some(ElementKind::face, {7, 8, 9, 13, 14, 15, 19, 20, 21})).indices() == Indices{14});
  for (const auto kind : kinds_of_cages) {
    Selection all(kind);
    CHECK(grown(cage, all).empty());
    CHECK(shrunk(cage, all).empty());
    all.select_all(element_count(cage, kind));
    CHECK(grown(cage, all) == all);
    CHECK(shrunk(cage, all) == all);  // the boundary of the cage stays selected
  }
}

TEST_CASE("without_a_cage_and_for_probes_there_are_no_elements") {
  const pose::Cage none;
  const auto probes = some(ElementKind::probe, {0, 2});
  CHECK(grown(none, probes) == probes);
  CHECK(shrunk(none, probes) == probes);
  for (const auto kind : kinds_of_cages) CHECK(grown(none, Selection(kind)).empty());
}

TEST_CASE("elements_of_polygons_are_counted_converted_and_linked") {
  const pose::Cage cage = two_quads();
  CHECK(element_count(cage, ElementKind::vertex) == 9);
  CHECK(element_count(cage, ElementKind::edge) == 8);
  CHECK(element_count(cage, ElementKind::face) == 2);
  CHECK(element_vertices(cage, ElementKind::face, 1) == Indices{4, 5, 7, 6});
  CHECK(selected_vertices(cage, some(ElementKind::vertex, {2, 8})) == Indices{2, 8});
  CHECK(selected_vertices(cage, some(ElementKind::face, {0})) == Indices{0, 1, 2, 3});
  CHECK(selected_vertices(cage, some(ElementKind::edge, {0, 1})) == Indices{0, 1, 2});
  const Selection face = some(ElementKind::face, {1});
  CHECK(converted(cage, face, ElementKind::edge).size() == 4);
  CHECK(converted(cage, face, ElementKind::vertex).indices() == Indices{4, 5, 6, 7});
  CHECK(converted(cage, converted(cage, face, ElementKind::edge), ElementKind::face) == face);
  CHECK(converted(cage, some(ElementKind::vertex, {0, 1, 2}), ElementKind::face).empty());
  CHECK(converted(cage, some(ElementKind::vertex, {0, 1, 2}), ElementKind::edge).size() == 2);
  CHECK(linked(cage, some(ElementKind::vertex, {5})).indices() == Indices{4, 5, 6, 7});
  CHECK(linked(cage, some(ElementKind::vertex, {8})).indices() == Indices{8});
  CHECK(linked(cage, some(ElementKind::edge, {0})).size() == 4);
  CHECK(linked(cage, some(ElementKind::face, {0, 1})).size() == 2);
}

TEST_CASE("switching_the_kind_converts_and_undo_brings_the_old_kind_back") {
  document::Document document = test::cube_document();
  document.changed_selection().select_all(8);
  select_kind(document, ElementKind::face);
  CHECK(document.selection().size() == 12);
  reset_selected(document);
  select_kind(document, ElementKind::vertex);
  undo(document);
  CHECK(document.selection().kind() == ElementKind::face);
  document::Document empty;
  select_kind(empty, ElementKind::edge);
  CHECK(empty.selection().kind() == ElementKind::edge);
}

TEST_CASE("elements_are_counted_in_words") {
  CHECK(counted(ElementKind::vertex, 1) == "a vertex");
  CHECK(counted(ElementKind::vertex, 3) == "3 vertices");
  CHECK(counted(ElementKind::edge, 1) == "an edge");
  CHECK(counted(ElementKind::face, 12) == "12 faces");
}
