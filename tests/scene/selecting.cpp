// Derived selections, on closed, open and non-manifold cages.
#include "scene/document/selecting.h"

#include <doctest/doctest.h>

#include "mesh/triangulation.h"
#include "scene/ball.h"
#include "scene/cube.h"
#include "scene/document/edit.h"
#include "scene/document/elements.h"

using namespace viete;
using namespace viete::scene;
using Indices = std::vector<std::uint32_t>;

namespace {

// n by n quads in a plane, and additional polygons.
mesh::Surface plane_of_quads(std::uint32_t n, std::vector<std::vector<std::uint32_t>> more = {}) {
  mesh::Surface s;
  s.polygon_starts = {0};
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x) s.positions.push_back({1.0 * x, 1.0 * y, 0.1 * (x == 0)});
  }
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t v = y * (n + 1) + x;
      more.insert(more.begin() + y * n + x, {v, v + 1, v + n + 2, v + n + 1});
    }
  }
  for (const auto& polygon : more) {
    s.corners.insert(s.corners.end(), polygon.begin(), polygon.end());
    s.polygon_starts.push_back(static_cast<std::uint32_t>(s.corners.size()));
  }
  mesh::triangulate(s);
  return s;
}

Selection some(ElementKind kind, std::vector<std::uint32_t> indices) {
  Selection selection(kind);
  selection.apply(indices, SelectMode::replace);
  return selection;
}

std::uint32_t edge_of(const deform::Cage& cage, std::uint32_t a, std::uint32_t b) {
  for (std::uint32_t e = 0; e < cage.edges.size(); ++e) {
    if (cage.edges[e] == mesh::Edge{std::min(a, b), std::max(a, b)}) return e;
  }
  FAIL("no such edge");
  return 0;
}

using Numbers = std::vector<std::uint32_t>;
constexpr ElementKind kinds_of_cages[] = {ElementKind::vertex, ElementKind::edge, ElementKind::face};

Selection selection(ElementKind kind, const Indices& indices) {
  Selection s(kind);
  s.apply(indices, SelectMode::replace);
  return s;
}

// Two separate quads and an unused vertex.
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

TEST_CASE("growing_adds_what_is_next_to_it_and_shrinking_takes_it_away_again") {
  const auto cage = deform::make_cage(plane_of_quads(6));
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
    CHECK(shrunk(cage, all) == all);  // the boundary stays
  }
}

TEST_CASE("a_loop_goes_straight_through_quads_between_boundaries_and_along_them") {
  const auto cage = deform::make_cage(plane_of_quads(4));
  const auto row = looped(cage, some(ElementKind::edge, {edge_of(cage, 11, 12)}));
  CHECK(selected_vertices(cage, row) == Numbers{10, 11, 12, 13, 14});
  CHECK(looped(cage, some(ElementKind::vertex, {7, 12})).indices() == Numbers{2, 7, 12, 17, 22});
  CHECK(looped(cage, some(ElementKind::vertex, {12})).indices() == Numbers{12});
  CHECK(looped(cage, some(ElementKind::edge, {edge_of(cage, 0, 1)})).size() == 16);
  CHECK(looped(cage, some(ElementKind::face, {5, 6})).indices() == Numbers{4, 5, 6, 7});
  CHECK(looped(cage, some(ElementKind::face, {5})).indices() == Numbers{5});
  CHECK(looped(cage, some(ElementKind::face, {1, 9, 13})).indices() == Numbers{1, 5, 9, 13});
}

TEST_CASE("a_loop_of_a_closed_cage_of_quads_comes_back_to_where_it_began") {
  // A ring of 5 by 4 quads: the two directions of a torus.
  mesh::Surface s;
  s.polygon_starts = {0};
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 4; ++j) {
      const double a = 1.2566 * i, b = 1.5708 * j;
      s.positions.push_back({(2 + std::cos(b)) * std::cos(a), (2 + std::cos(b)) * std::sin(a), std::sin(b)});
      const auto at = [](int k, int l) { return static_cast<std::uint32_t>(4 * (k % 5) + l % 4); };
      for (const auto v : {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}) s.corners.push_back(v);
      s.polygon_starts.push_back(static_cast<std::uint32_t>(s.corners.size()));
    }
  }
  mesh::triangulate(s);
  const auto cage = deform::make_cage(std::move(s));
  CHECK(looped(cage, some(ElementKind::edge, {edge_of(cage, 0, 4)})).size() == 5);
  CHECK(looped(cage, some(ElementKind::edge, {edge_of(cage, 0, 1)})).size() == 4);
  CHECK(looped(cage, some(ElementKind::face, {0, 4})).size() == 5);
  CHECK(looped(cage, some(ElementKind::face, {0, 1})).size() == 4);
}

TEST_CASE("on_triangles_a_loop_goes_the_straightest_way_and_ends") {
  const auto cage = deform::make_cage(test::ball(1, 3));
  for (const std::uint32_t e : {0u, 7u, 100u, 1000u}) {
    const auto loop = looped(cage, some(ElementKind::edge, {e}));
    CHECK(loop.size() > 8);
    CHECK(loop.size() < 200);
  }
  const auto faces = looped(cage, some(ElementKind::face, {0, 1}));
  CHECK(faces.size() >= 2);
  // Edges of a triangulated cube turn by a right angle: there are no loops.
  const auto cube = deform::make_cage(test::cube(1));
  CHECK(looped(cube, some(ElementKind::edge, {edge_of(cube, 0, 1)})).size() == 1);
}

TEST_CASE("a_ring_goes_across_quads_and_pairs_of_triangles_as_if_they_were_quads") {
  auto quads = plane_of_quads(4);
  const auto cage = deform::make_cage(quads);
  const auto across = [&](const deform::Cage& c) {
    return ringed(c, some(ElementKind::edge, {edge_of(c, 11, 12)}));
  };
  const auto ring = across(cage);  // between the columns 1 and 2, in each of five rows
  CHECK(selected_vertices(cage, ring) == Numbers{1, 2, 6, 7, 11, 12, 16, 17, 21, 22});
  CHECK(ring.size() == 5);
  CHECK(ringed(cage, some(ElementKind::vertex, {11, 12})).indices() == selected_vertices(cage, ring));
  CHECK(ringed(cage, some(ElementKind::vertex, {12})).indices() == Numbers{12});
  CHECK(ringed(cage, some(ElementKind::face, {5})).indices() == Numbers{5});
  // The same, triangulated.
  mesh::Surface cut;
  cut.positions = quads.positions;
  cut.polygon_starts = {0};
  for (const auto& triangle : quads.triangles) {
    cut.corners.insert(cut.corners.end(), triangle.begin(), triangle.end());
    cut.polygon_starts.push_back(static_cast<std::uint32_t>(cut.corners.size()));
  }
  mesh::triangulate(cut);
  const auto triangles = deform::make_cage(cut);
  const auto same = across(triangles);
  CHECK(same.size() == 5);
  CHECK(selected_vertices(triangles, same) == Numbers{1, 2, 6, 7, 11, 12, 16, 17, 21, 22});
  const auto ball = deform::make_cage(test::ball(1, 3));
  for (const std::uint32_t e : {0u, 7u, 100u}) CHECK(ringed(ball, some(ElementKind::edge, {e})).contains(e));
}

TEST_CASE("loops_end_at_nonmanifold_edges") {
  // Two fins on opposite sides of an edge between vertices 5 and 6 of a plane: four faces at one edge.
  auto s = plane_of_quads(3);
  s.positions.push_back({1, 1, 1});
  s.positions.push_back({2, 1, 1});
  for (const std::vector<std::uint32_t>& fin : {Numbers{5, 6, 17, 16}, Numbers{16, 17, 6, 5}}) {
    s.corners.insert(s.corners.end(), fin.begin(), fin.end());
    s.polygon_starts.push_back(static_cast<std::uint32_t>(s.corners.size()));
  }
  s.triangles.clear(), s.triangle_polygon.clear();
  mesh::triangulate(s);
  deform::Cage cage;
  cage.surface = s;
  cage.edges = mesh::polygon_edges(s);
  cage.diagonal = 5;
  for (const auto kind : kinds_of_cages) {
    for (std::uint32_t i = 0; i < element_count(cage, kind); ++i) {
      const auto one = some(kind, {i});
      CHECK(grown(cage, one).contains(i));
      CHECK(looped(cage, one).contains(i));
      CHECK(similar(cage, s.positions, one).contains(i));
      CHECK(facing(cage, s.positions, one).contains(i));
      CHECK(shrunk(cage, grown(cage, one)).contains(i));
    }
  }
  CHECK(looped(cage, some(ElementKind::face, {1, 4})).size() == 2);
}

TEST_CASE("similar_is_as_many_edges_as_long_as_large_within_a_tenth") {
  const auto cage = deform::make_cage(plane_of_quads(3));
  const auto& p = cage.surface.positions;
  CHECK(similar(cage, p, some(ElementKind::vertex, {0})).indices() == Numbers{0, 3, 12, 15});
  CHECK(similar(cage, p, some(ElementKind::vertex, {5})).indices() == Numbers{5, 6, 9, 10});
  CHECK(similar(cage, p, some(ElementKind::face, {0})).size() == 9);
  auto stretched = p;
  stretched[15] = {5, 3, 0};
  CHECK(similar(cage, stretched, some(ElementKind::edge, {edge_of(cage, 14, 15)})).size() == 1);
  CHECK(similar(cage, stretched, some(ElementKind::edge, {edge_of(cage, 5, 6)})).size() > 15);
  CHECK(similar(cage, p, some(ElementKind::vertex, {})).empty());
}

TEST_CASE("facing_is_the_same_way_for_faces_and_either_way_for_edges") {
  const auto cage = deform::make_cage(test::cube(1));
  const auto& p = cage.surface.positions;
  CHECK(facing(cage, p, some(ElementKind::face, {0})).indices() == Numbers{0, 1});
  CHECK(facing(cage, p, some(ElementKind::edge, {edge_of(cage, 0, 1)})).size() == 4);
  CHECK(facing(cage, p, some(ElementKind::vertex, {3})).indices() == Numbers{3});
}

TEST_CASE("a_side_contains_elements_that_neither_cross_nor_lie_in_the_middle_plane") {
  const auto cage = deform::make_cage(plane_of_quads(4));
  CHECK(on_side(cage, ElementKind::vertex, 0, true, 2).indices() ==
        Numbers{3, 4, 8, 9, 13, 14, 18, 19, 23, 24});
  CHECK(on_side(cage, ElementKind::face, 0, false, 2).size() == 8);
  CHECK(on_side(cage, ElementKind::face, 1, true, 2).size() == 8);
  CHECK(on_side(cage, ElementKind::edge, 0, true, 2).size() == 8 + 10);
  CHECK(on_side(cage, ElementKind::vertex, 2, false, 0).empty());
}

TEST_CASE("without_a_cage_and_for_probes_there_are_no_elements") {
  const deform::Cage none;
  const auto probes = some(ElementKind::probe, {0, 2});
  CHECK(grown(none, probes) == probes);
  CHECK(shrunk(none, probes) == probes);
  CHECK(looped(none, probes) == probes);
  CHECK(similar(none, {}, probes) == probes);
  CHECK(facing(none, {}, probes) == probes);
  for (const auto kind : kinds_of_cages) {
    CHECK(grown(none, Selection(kind)).empty());
    CHECK(looped(none, Selection(kind)).empty());
    CHECK(on_side(none, kind, 0, true, 0).empty());
  }
}

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
