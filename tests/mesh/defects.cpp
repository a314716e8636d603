#include "mesh/defects.h"

#include "support/shapes.h"

using namespace viete;
using namespace viete::mesh;

using List = std::vector<std::uint32_t>;

TEST_CASE("sound_surfaces_have_no_duplicate_or_nonmanifold_vertices") {
  for (const Surface& s : {test::cube(), test::sphere(3), test::torus(20, 10), test::torus(12, 8, true)}) {
    CHECK(duplicate_vertices(s).empty());
    CHECK(nonmanifold_vertices(s).empty());
  }
}

TEST_CASE("duplicate_vertices_are_listed_unless_unused") {
  Surface s = from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {1, 0, 0}},
                             {{0, 1, 2}, {4, 5, 3}});
  CHECK(duplicate_vertices(s) == List{3, 4});
  s.positions[3][1] += 1e-15;
  CHECK(duplicate_vertices(s) == List{4});
}

TEST_CASE("vertex_of_two_fans_is_nonmanifold") {
  // Two tetrahedra with a common vertex. Every edge has two triangles.
  const Surface s = from_triangles(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
      {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 4, 5}, {0, 6, 4}, {0, 5, 6}, {4, 6, 5}});
  CHECK(nonmanifold_vertices(s) == List{0});
}

TEST_CASE("thin_triangles_are_listed_at_every_scale_except_flat_ones") {
  const Surface s =
      from_triangles({{0, 0, 0}, {1, 0, 0}, {0.5, 1e-4, 0}, {0.5, 0.5, 0}, {0.5, 0, 0}, {0.5, 1e-14, 0}},
                     {{0, 1, 3}, {0, 1, 2}, {0, 1, 4}, {0, 0, 1}, {2, 0, 1}, {0, 1, 5}});
  for (const double scale : {1e-100, 1e-30, 1.0, 1e30, 1e100}) {
    CHECK(thin_triangles(test::moved(s, scale), 1e-3) == List{1, 4});
    CHECK(thin_triangles(test::moved(s, scale), 1e-5).empty());
  }
}

namespace {

Surface rotated(Surface s) {
  for (Point& p : s.positions)
    p = {0.36 * p[0] + 0.48 * p[1] - 0.8 * p[2], -0.8 * p[0] + 0.6 * p[1],
         0.48 * p[0] + 0.64 * p[1] + 0.6 * p[2]};
  return s;
}

}  // namespace

TEST_CASE("sound_surfaces_have_no_self_intersections_at_any_scale_or_angle") {
  for (const Surface& s : {test::cube(), test::sphere(3), test::torus(40, 20), test::torus(12, 8, true)}) {
    for (const double scale : {1e-100, 1e-30, 1.0, 1e30, 1e100}) {
      CHECK(self_intersecting_triangles(test::moved(s, scale)).empty());
      CHECK(self_intersecting_triangles(rotated(test::moved(s, scale))).empty());
    }
    CHECK(self_intersecting_triangles(test::moved(s, 1, 1e4)).empty());
  }
}

TEST_CASE("crossing_triangles_are_both_listed") {
  const Surface s = from_triangles(
      {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {9, 9, 0.5}, {9, 0, 9}, {8, 0, 9}, {9, 1, 9}},
      {{0, 1, 2}, {6, 7, 8}, {3, 4, 5}});
  CHECK(self_intersecting_triangles(s) == List{0, 2});
  CHECK(self_intersecting_triangles(rotated(s)) == List{0, 2});
}

TEST_CASE("edge_exactly_through_an_edge_or_vertex_is_a_crossing") {
  // In the first pair, an edge goes through an edge. In the second pair, an edge goes through a vertex.
  CHECK(self_intersecting_triangles(from_triangles(
            {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 0, -1}, {2, 0, 1}, {2, -3, 0}}, {{0, 1, 2}, {3, 4, 5}})) ==
        List{0, 1});
  CHECK(self_intersecting_triangles(from_triangles(
            {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 0, -1}, {4, 0, 1}, {9, 0, 0}}, {{0, 1, 2}, {3, 4, 5}})) ==
        List{0, 1});
}

TEST_CASE("touching_is_not_a_crossing") {
  // First a triangle with a vertex on the face of another triangle, then two cubes that touch at an edge.
  CHECK(self_intersecting_triangles(
            from_triangles({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {1, 2, 3}, {2, 1, 3}},
                           {{0, 1, 2}, {3, 4, 5}}))
            .empty());
  Surface beside = test::cube();
  for (Point& p : beside.positions) {
    p[0] += 2;
    p[1] += 2;
  }
  CHECK(self_intersecting_triangles(test::both(test::cube(), beside)).empty());
}

TEST_CASE("coplanar_overlap_and_duplicate_triangles_are_crossings") {
  CHECK(self_intersecting_triangles(from_triangles(
            {{0, 0, 1}, {4, 0, 1}, {0, 4, 1}, {1, 1, 1}, {5, 1, 1}, {1, 5, 1}, {-1, -1, 1}, {-2, 0, 1}},
            {{0, 1, 2}, {3, 4, 5}, {0, 7, 6}})) == List{0, 1});
  CHECK(self_intersecting_triangles(from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}},
                                                   {{0, 1, 2}, {0, 2, 3}})) == List{0, 1});
}

TEST_CASE("neighbour_piercing_beyond_the_common_vertex_is_a_crossing") {
  CHECK(self_intersecting_triangles(from_triangles({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 2, -1}, {1, 1, 1}},
                                                   {{0, 1, 2}, {0, 3, 4}})) == List{0, 1});
}

TEST_CASE("triangles_without_area_cross_nothing") {
  CHECK(self_intersecting_triangles(from_triangles({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}},
                                                   {{0, 1, 2}, {3, 4, 4}, {3, 4, 3}}))
            .empty());
  CHECK(self_intersecting_triangles(Surface{}).empty());
}

TEST_CASE("sweep_agrees_with_brute_force") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> at(0, 1), off(-0.15, 0.15);
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  for (std::uint32_t t = 0; t < 150; ++t) {
    const Point center{at(random), 3 * at(random), at(random)};
    for (int i = 0; i < 3; ++i)
      points.push_back({center[0] + off(random), center[1] + off(random), center[2] + off(random)});
    triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  List expected;
  for (std::uint32_t s = 0; s < triangles.size(); ++s) {
    bool cut = false;
    for (std::uint32_t t = 0; t < triangles.size() && !cut; ++t)
      if (s != t)
        cut = !self_intersecting_triangles(from_triangles(points, {triangles[s], triangles[t]})).empty();
    if (cut) expected.push_back(s);
  }
  CHECK(expected.size() > 20);
  CHECK(expected.size() < 140);
  CHECK(self_intersecting_triangles(from_triangles(points, triangles)) == expected);
}

TEST_CASE("the_search_can_be_cancelled") {
  base::Progress progress;
  progress.cancel();
  CHECK_THROWS_AS(self_intersecting_triangles(test::cube(), &progress), base::Cancelled);
}
