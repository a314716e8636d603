#include "document/elements.h"

#include <doctest/doctest.h>

#include "support/cube.h"

using namespace viete;
using namespace viete::document;
using Numbers = std::vector<std::uint32_t>;

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

Selection some(ElementKind kind, const Numbers& indices) {
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
  CHECK(grown(cage, some(ElementKind::vertex, {24})).indices() == Numbers{17, 23, 24, 25, 31});
  CHECK(grown(cage, some(ElementKind::face, {14})).indices() == Numbers{7, 8, 9, 13, 14, 15, 19, 20, 21});
  CHECK(shrunk(cage, some(ElementKind::vertex, {17, 23, 24, 25, 31})).indices() == Numbers{24});
  CHECK(shrunk(cage, some(ElementKind::face, {7, 8, 9, 13, 14, 15, 19, 20, 21})).indices() == Numbers{14});
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
  CHECK(element_vertices(cage, ElementKind::face, 1) == Numbers{4, 5, 7, 6});
  CHECK(selected_vertices(cage, some(ElementKind::vertex, {2, 8})) == Numbers{2, 8});
  CHECK(selected_vertices(cage, some(ElementKind::face, {0})) == Numbers{0, 1, 2, 3});
  CHECK(selected_vertices(cage, some(ElementKind::edge, {0, 1})) == Numbers{0, 1, 2});
  const Selection face = some(ElementKind::face, {1});
  CHECK(converted(cage, face, ElementKind::edge).size() == 4);
  CHECK(converted(cage, face, ElementKind::vertex).indices() == Numbers{4, 5, 6, 7});
  CHECK(converted(cage, converted(cage, face, ElementKind::edge), ElementKind::face) == face);
  CHECK(converted(cage, some(ElementKind::vertex, {0, 1, 2}), ElementKind::face).empty());
  CHECK(converted(cage, some(ElementKind::vertex, {0, 1, 2}), ElementKind::edge).size() == 2);
  CHECK(linked(cage, some(ElementKind::vertex, {5})).indices() == Numbers{4, 5, 6, 7});
  CHECK(linked(cage, some(ElementKind::vertex, {8})).indices() == Numbers{8});
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
