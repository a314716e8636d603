#include "mesh/edge_paths.h"

#include <doctest/doctest.h>

#include "mesh/shapes.h"

using namespace viete;
using namespace viete::mesh;

TEST_CASE("paths_along_edges_join_vertices_that_are_no_farther_than_their_length") {
  std::vector<Point> p;  // a strip of squares of side 1, and a triangle beside it
  std::vector<Triangle> t;
  for (std::uint32_t i = 0; i < 10; ++i) {
    p.push_back({double(i), 0, 0}), p.push_back({double(i), 1, 0});
    if (i > 0) t.push_back({2 * i - 2, 2 * i, 2 * i - 1}), t.push_back({2 * i, 2 * i + 1, 2 * i - 1});
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
