#include "mesh/defects.h"

#include <doctest/doctest.h>

#include "mesh/shapes.h"

using namespace viete;
using namespace viete::mesh;

using List = std::vector<std::uint32_t>;

TEST_CASE("sound_surfaces_have_neither_doubled_nor_pinched_vertices") {
  for (const Surface& s : {test::cube(), test::sphere(3), test::torus(20, 10), test::torus(12, 8, true)}) {
    CHECK(duplicate_vertices(s).empty());
    CHECK(nonmanifold_vertices(s).empty());
  }
}

TEST_CASE("vertices_on_others_are_named_and_unused_ones_are_not") {
  Surface s = from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {1, 0, 0}},
                             {{0, 1, 2}, {4, 5, 3}});
  CHECK(duplicate_vertices(s) == List{3, 4});
  s.positions[3][1] += 1e-15;
  CHECK(duplicate_vertices(s) == List{4});
}

TEST_CASE("a_vertex_that_joins_two_fans_is_pinched") {
  // Two tetrahedra with one vertex in common: every edge has two triangles.
  const Surface s = from_triangles(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
      {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 4, 5}, {0, 6, 4}, {0, 5, 6}, {4, 6, 5}});
  CHECK(nonmanifold_vertices(s) == List{0});
}

TEST_CASE("an_edge_of_three_triangles_pinches_nothing") {
  const Surface s = from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}},
                                   {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {0, 0, 1}});
  CHECK(nonmanifold_vertices(s).empty());
}

TEST_CASE("thin_triangles_are_named_at_every_scale_and_flat_ones_are_not") {
  const Surface s =
      from_triangles({{0, 0, 0}, {1, 0, 0}, {0.5, 1e-4, 0}, {0.5, 0.5, 0}, {0.5, 0, 0}, {0.5, 1e-14, 0}},
                     {{0, 1, 3}, {0, 1, 2}, {0, 1, 4}, {0, 0, 1}, {2, 0, 1}, {0, 1, 5}});
  for (const double scale : {1e-100, 1e-30, 1.0, 1e30, 1e100}) {
    CHECK(thin_triangles(test::moved(s, scale), 1e-3) == List{1, 4});
    CHECK(thin_triangles(test::moved(s, scale), 1e-5).empty());
  }
}
