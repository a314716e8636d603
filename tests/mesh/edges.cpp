#include "mesh/edges.h"

#include <doctest/doctest.h>

using namespace viete::mesh;

TEST_CASE("a_quad_has_four_edges_and_shares_one_with_its_neighbour") {
  Surface surface;
  surface.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
  surface.corners = {0, 1, 2, 3, 4, 2, 1};
  surface.polygon_starts = {0, 4, 7};
  fan_triangulate(surface);
  CHECK(polygon_edges(surface) == std::vector<Edge>{{0, 1}, {0, 3}, {1, 2}, {1, 4}, {2, 3}, {2, 4}});
}

TEST_CASE("repeated_corners_make_no_edge") {
  const Surface surface = from_triangles({{0, 0, 0}, {1, 0, 0}}, {{0, 0, 1}});
  CHECK(polygon_edges(surface) == std::vector<Edge>{{0, 1}});
  CHECK(polygon_edges({}).empty());
}
