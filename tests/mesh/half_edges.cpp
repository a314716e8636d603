#include "mesh/half_edges.h"
#include "mesh/edge_paths.h"

#include "mesh/union_find.h"
#include "support/shapes.h"

using namespace viete;
using namespace viete::mesh;

TEST_CASE("an_inner_edge_has_two_sides_in_opposite_directions_by_triangle") {
  const Surface s = test::sphere(2);
  const HalfEdges table = half_edges(s.positions.size(), s.triangles);
  CHECK(2 * table.edges.size() == 3 * s.triangles.size());
  CHECK(table.edges == polygon_edges(s));
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    const auto sides = table.of(e);
    REQUIRE(sides.size() == 2);
    CHECK(sides[0].triangle < sides[1].triangle);
    CHECK(sides[0].forward != sides[1].forward);
    for (const auto& [t, forward] : sides) {
      const auto& c = s.triangles[t];
      const auto at = std::find(c.begin(), c.end(), table.edges[e][forward ? 0 : 1]) - c.begin();
      CHECK(c[(at + 1) % 3] == table.edges[e][forward ? 1 : 0]);
    }
  }
}

TEST_CASE("edges_of_any_number_of_triangles_are_listed_except_of_collapsed_ones") {
  const std::vector<Triangle> fan = {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}, {0, 1, 1}};
  const HalfEdges table = half_edges(5, fan);
  CHECK(table.edges.size() == 7);
  REQUIRE(table.edges[0] == Edge{0, 1});
  REQUIRE(table.of(0).size() == 3);
  CHECK(table.of(0)[1].forward);
  CHECK_FALSE(table.of(0)[2].forward);
  CHECK(half_edges(3, {}).edges.empty());
}

TEST_CASE("a_quad_has_four_edges_and_shares_one_with_its_neighbour") {
  Surface surface;
  surface.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
  surface.corners = {0, 1, 2, 3, 4, 2, 1};
  surface.polygon_starts = {0, 4, 7};
  triangulate(surface);
  CHECK(polygon_edges(surface) == std::vector<Edge>{{0, 1}, {0, 3}, {1, 2}, {1, 4}, {2, 3}, {2, 4}});
}

TEST_CASE("joined_sets_share_a_number") {
  UnionFind sets(5);
  CHECK(sets.join(0, 1));
  CHECK(sets.join(3, 4));
  CHECK_FALSE(sets.join(1, 0));
  CHECK(sets.find(0) == sets.find(1));
  CHECK(sets.find(3) == sets.find(4));
  CHECK(sets.find(0) != sets.find(3));
  CHECK(sets.find(2) == 2);
  CHECK(sets.join(4, 0));
  CHECK(sets.find(1) == sets.find(3));
  sets.reset(2);
  CHECK(sets.find(1) != sets.find(0));
}

TEST_CASE("vertices_are_joined_by_paths_up_to_the_given_length") {
  std::vector<Point> p;  // a strip of squares of side 1, and a separate triangle
  std::vector<Triangle> t;
  for (std::uint32_t i = 0; i < 10; ++i) {
    p.push_back({double(i), 0, 0});
    p.push_back({double(i), 1, 0});
    if (i > 0) {
      t.push_back({2 * i - 2, 2 * i, 2 * i - 1});
      t.push_back({2 * i, 2 * i + 1, 2 * i - 1});
    }
  }
  p.insert(p.end(), {{0, 0, 0.1}, {1, 0, 0.1}, {0, 1, 0.1}});
  t.push_back({20, 21, 22});
  const Surface surface = from_triangles(p, t);
  const EdgePaths paths(surface);
  CHECK(paths.joined(0, 18, 9));
  CHECK_FALSE(paths.joined(0, 18, 8.9));
  CHECK(paths.joined(18, 0, 9));
  CHECK(paths.joined(3, 3, 0));
  CHECK_FALSE(paths.joined(0, 20, 100));
  CHECK(paths.part(0) == paths.part(19));
  CHECK(paths.part(20) == paths.part(22));
  CHECK(paths.part(0) != paths.part(20));
}
