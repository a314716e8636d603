#include "mesh/summary.h"

#include "support/shapes.h"

using namespace viete;
using namespace viete::mesh;

namespace {
const double pi = std::acos(-1.0);
}

TEST_CASE("a_cube_has_the_area_and_volume_of_a_cube") {
  const Summary f = summarize(test::cube());
  CHECK(f.vertices == 8);
  CHECK(f.polygons == 6);
  CHECK(f.triangles == 12);
  CHECK(f.edges == 12);
  CHECK(f.parts == 1);
  CHECK(f.area == doctest::Approx(24).epsilon(1e-14));
  CHECK(f.volume == doctest::Approx(8).epsilon(1e-14));
  CHECK(f.closed());
  CHECK(f.manifold());
  CHECK(f.oriented());
}

TEST_CASE("a_sphere_is_closed_and_its_measures_converge") {
  double area_gap = 4 * pi, volume_gap = 4 * pi;
  for (int level = 1; level <= 5; ++level) {
    const Summary f = summarize(test::sphere(level));
    CHECK(f.closed());
    CHECK(f.vertices + f.triangles == f.edges + 2);
    CHECK(4 * pi - f.area < 0.5 * area_gap);
    CHECK(4 * pi / 3 - f.volume < 0.5 * volume_gap);
    area_gap = 4 * pi - f.area;
    volume_gap = 4 * pi / 3 - f.volume;
  }
  CHECK(area_gap < 0.02);
}

TEST_CASE("measures_scale_from_1e_minus_100_to_1e100") {
  for (const double scale : {1e-100, 1e-30, 1e-7, 1e30, 1e100}) {
    const Summary f = summarize(test::moved(test::cube(), scale));
    CHECK(f.area / scale / scale == doctest::Approx(24).epsilon(1e-13));
    CHECK(f.volume / scale / scale / scale == doctest::Approx(8).epsilon(1e-13));
    CHECK(f.degenerate_polygons.empty());
  }
  CHECK(summarize(test::moved(test::cube(), 1, 1e7)).volume == doctest::Approx(8).epsilon(1e-12));
  CHECK(summarize(test::moved(test::cube(), -1)).volume == doctest::Approx(-8).epsilon(1e-13));
}

TEST_CASE("a_missing_triangle_leaves_its_three_edges_as_boundary") {
  Surface s = test::sphere(1);
  const Triangle gone = s.triangles.back();
  s.triangles.pop_back();
  const Summary f = summarize(from_triangles(s.positions, s.triangles));
  CHECK(!f.closed());
  REQUIRE(f.boundary_edges.size() == 3);
  for (const Edge& e : f.boundary_edges) {
    CHECK(e[0] < e[1]);
    CHECK(std::count(gone.begin(), gone.end(), e[0]) + std::count(gone.begin(), gone.end(), e[1]) == 2);
  }
}

TEST_CASE("flipped_triangle_has_three_misoriented_edges") {
  Surface s = test::sphere(1);
  std::swap(s.triangles[5][0], s.triangles[5][1]);
  const Summary f = summarize(from_triangles(s.positions, s.triangles));
  CHECK(f.closed());
  CHECK(f.manifold());
  CHECK(f.misoriented_edges.size() == 3);
}

TEST_CASE("a_fin_makes_its_edge_nonmanifold") {
  Surface s = test::sphere(1);
  const Triangle t = s.triangles[0];
  s.positions.push_back({3, 3, 3});
  s.triangles.push_back({t[0], t[1], static_cast<std::uint32_t>(s.positions.size() - 1)});
  const Summary f = summarize(from_triangles(s.positions, s.triangles));
  CHECK(f.nonmanifold_edges == std::vector<Edge>{{std::min(t[0], t[1]), std::max(t[0], t[1])}});
  CHECK(f.boundary_edges.size() == 2);
}

TEST_CASE("unused_vertices_are_not_components") {
  Surface a = test::both(test::sphere(1), test::moved(test::cube(), 0.1, 10));
  a.positions.push_back({5, 5, 5});
  const Summary f = summarize(a);
  CHECK(f.parts == 2);
  CHECK(f.unused_vertices == std::vector<std::uint32_t>{static_cast<std::uint32_t>(a.positions.size() - 1)});
}

TEST_CASE("repeated_corners_and_flat_triangles_are_degenerate_at_every_scale") {
  for (const double scale : {1e-100, 1e-30, 1.0, 1e30, 1e100}) {
    Surface s =
        from_triangles({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1e-9, 0}}, {{0, 1, 2}, {0, 1, 1}, {0, 1, 3}});
    CHECK(summarize(test::moved(s, scale)).degenerate_polygons == std::vector<std::uint32_t>{0, 1});
  }
}

// A cube of edge length 2. Vertex 8 is near the middle of edge 0-1, at the distance `off` from the edge. The
// two faces at the edge are listed from their corner `first`.
static Surface cube_with_a_corner_in_an_edge(double off, int first) {
  Surface s = test::cube();
  s.positions.push_back(0.5 * (s.positions[0] + s.positions[1]) + Point{0, off, off});
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> starts{0};
  for (std::size_t p = 0; p < s.polygon_count(); ++p) {
    std::vector<std::uint32_t> face(s.corners.begin() + s.polygon_starts[p],
                                    s.corners.begin() + s.polygon_starts[p + 1]);
    for (std::size_t i = 0; i < 4; ++i) {
      if (face[i] + face[(i + 1) % 4] != 1) continue;
      face.insert(face.begin() + std::ptrdiff_t(i) + 1, 8);
      std::ranges::rotate(face, face.begin() + first);
      break;
    }
    corners.insert(corners.end(), face.begin(), face.end());
    starts.push_back(static_cast<std::uint32_t>(corners.size()));
  }
  s.corners = corners;
  s.polygon_starts = starts;
  triangulate(s);
  return s;
}

TEST_CASE("a_corner_near_the_middle_of_an_edge_is_an_ordinary_corner") {
  for (const double off : {0.0, 1e-12, 1e-6, 1e-3, -1e-3})
    for (int first = 0; first < 5; ++first) {
      CAPTURE(off);
      CAPTURE(first);
      const Surface s = cube_with_a_corner_in_an_edge(off, first);
      const Summary f = summarize(s);
      CHECK((f.closed() && f.manifold() && f.oriented()));
      CHECK(f.edges == 13);
      CHECK(f.degenerate_polygons.empty());
      CHECK(f.volume == doctest::Approx(8).epsilon(0.3 * std::abs(off) + 1e-9));
      CHECK(topology(s, f)->genus == 0);
      double largest = 0;  // of the triangles at the corner
      for (const auto& t : s.triangles)
        if (std::ranges::count(t, 8u)) largest = std::max(largest, area(s.positions, t));
      CHECK(largest > 0.9);
    }
}

TEST_CASE("point_sets_have_a_summary") {
  Surface s;
  s.positions = {{1, 2, 3}, {4, 5, 6}};
  s.polygon_starts = {0};
  const Summary f = summarize(s);
  CHECK(f.vertices == 2);
  CHECK(f.parts == 0);
  CHECK(!f.closed());
  CHECK(f.unused_vertices.size() == 2);
  CHECK(f.area == 0);
  CHECK(summarize(Surface{}).vertices == 0);
}

namespace {

std::optional<Topology> topology_of(const Surface& s) {
  return topology(s, summarize(s));
}

}  // namespace

TEST_CASE("sphere_and_cube_have_genus_zero_a_torus_one_and_a_cut_torus_has_two_loops") {
  const struct {
    Surface surface;
    std::ptrdiff_t euler;
    std::size_t genus, holes;
  } cases[] = {{test::sphere(3), 2, 0, 0},
               {test::cube(), 2, 0, 0},
               {test::torus(16, 8), 0, 1, 0},
               {test::torus(16, 8, true), 0, 0, 2}};  // without a ring: a cylinder with two loops
  for (const auto& c : cases) {
    const auto t = topology_of(c.surface);
    REQUIRE(t);
    CHECK(t->euler == c.euler);
    CHECK(t->genus == c.genus);
    CHECK(t->holes == c.holes);
  }
}

TEST_CASE("unused_vertices_and_several_parts_do_not_disturb_the_genus") {
  Surface a = test::torus(12, 6);
  const Surface b = test::moved(test::sphere(1), 0.1, 10);
  a.positions.push_back({9, 9, 9});
  const auto shift = static_cast<std::uint32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const Triangle& t : b.triangles) a.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  const auto t = topology_of(from_triangles(a.positions, a.triangles));
  REQUIRE(t);
  CHECK(t->euler == 2);
  CHECK(t->genus == 1);
}

TEST_CASE("non_manifolds_have_no_topology") {
  const std::vector<Point> p = {{0, 0, 0},  {1, 0, 0},  {0, 1, 0}, {0, 0, 1},
                                {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  // Two closed parts with a common vertex. The triangles are tested in several orders.
  std::vector<Triangle> order = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3},
                                 {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}};
  for (int turn = 0; turn < 8; ++turn) {
    std::rotate(order.begin(), order.begin() + 1, order.end());
    CHECK(!topology_of(from_triangles(p, order)));
  }
  const std::vector<std::vector<Triangle>> others = {
      {{0, 2, 1}, {0, 4, 5}, {0, 1, 3}, {0, 5, 6}, {0, 3, 2}, {0, 6, 4}, {1, 2, 3}, {4, 6, 5}},
      {{0, 1, 2}, {0, 4, 5}},             // two open fans that touch at a vertex
      {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}},  // three triangles at an edge
      {{0, 1, 2}, {0, 1, 3}},             // opposite orientations
      {{0, 1, 2}, {3, 3, 4}}};            // a repeated corner
  for (const auto& triangles : others) CHECK(!topology_of(from_triangles(p, triangles)));
}
