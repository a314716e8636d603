#include "scene/document/elements.h"

#include <doctest/doctest.h>

#include "mesh/triangulation.h"
#include "scene/cube.h"
#include "scene/document/edit.h"

using namespace viete;
using namespace viete::scene;
using Indices = std::vector<std::uint32_t>;

namespace {

Selection selection(ElementKind kind, const Indices& indices) {
  Selection s(kind);
  s.apply(indices, SelectMode::replace);
  return s;
}

// Two quads that share nothing, and a vertex that no polygon uses.
deform::Cage two_quads() {
  mesh::Surface surface;
  for (int i = 0; i < 9; ++i)
    surface.positions.push_back({double(i % 4 % 3), double(i % 4 / 2), double(i / 4)});
  surface.corners = {0, 1, 3, 2, 4, 5, 7, 6};
  surface.polygon_starts = {0, 4, 8};
  mesh::triangulate(surface);
  return deform::make_cage(surface);
}

}  // namespace

TEST_CASE("edges_and_faces_are_those_of_the_polygons_not_of_the_triangles") {
  const deform::Cage cage = two_quads();
  CHECK(element_count(cage, ElementKind::vertex) == 9);
  CHECK(element_count(cage, ElementKind::edge) == 8);
  CHECK(element_count(cage, ElementKind::face) == 2);
  CHECK(element_vertices(cage, ElementKind::face, 1) == Indices{4, 5, 7, 6});
}

TEST_CASE("selected_vertices_are_those_of_all_elements_each_once") {
  const deform::Cage cage = two_quads();
  CHECK(selected_vertices(cage, selection(ElementKind::vertex, {2, 8})) == Indices{2, 8});
  CHECK(selected_vertices(cage, selection(ElementKind::face, {0})) == Indices{0, 1, 2, 3});
  CHECK(selected_vertices(cage, selection(ElementKind::edge, {0, 1})) == Indices{0, 1, 2});
}

TEST_CASE("converting_keeps_what_is_wholly_selected") {
  const deform::Cage cage = two_quads();
  const Selection face = selection(ElementKind::face, {1});
  CHECK(converted(cage, face, ElementKind::edge).size() == 4);
  CHECK(converted(cage, face, ElementKind::vertex).indices() == Indices{4, 5, 6, 7});
  CHECK(converted(cage, converted(cage, face, ElementKind::edge), ElementKind::face) == face);
  CHECK(converted(cage, selection(ElementKind::vertex, {0, 1, 2}), ElementKind::face).empty());
  CHECK(converted(cage, selection(ElementKind::vertex, {0, 1, 2}), ElementKind::edge).size() == 2);
}

TEST_CASE("linked_reaches_all_that_edges_connect_and_no_other_part") {
  const deform::Cage cage = two_quads();
  CHECK(linked(cage, selection(ElementKind::vertex, {5})).indices() == Indices{4, 5, 6, 7});
  CHECK(linked(cage, selection(ElementKind::vertex, {8})).indices() == Indices{8});
  CHECK(linked(cage, selection(ElementKind::edge, {0})).size() == 4);
  CHECK(linked(cage, selection(ElementKind::face, {0, 1})).size() == 2);
}

TEST_CASE("switching_the_kind_converts_and_undo_brings_the_old_kind_back") {
  scene::Document document = test::cube_document();
  document.selection.select_all(8);
  select_kind(document, ElementKind::face);
  CHECK(document.selection.size() == 12);
  reset_selected(document);
  select_kind(document, ElementKind::vertex);
  undo(document);
  CHECK(document.selection.kind() == ElementKind::face);
  scene::Document empty;
  select_kind(empty, ElementKind::edge);
  CHECK(empty.selection.kind() == ElementKind::edge);
}

TEST_CASE("elements_are_counted_in_words") {
  CHECK(counted(ElementKind::vertex, 1) == "a vertex");
  CHECK(counted(ElementKind::vertex, 3) == "3 vertices");
  CHECK(counted(ElementKind::edge, 1) == "an edge");
  CHECK(counted(ElementKind::face, 12) == "12 faces");
}
