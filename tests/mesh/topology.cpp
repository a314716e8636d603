#include "mesh/topology.h"

#include <doctest/doctest.h>

#include "mesh/shapes.h"

using namespace viete;
using namespace viete::mesh;

namespace {

std::optional<Topology> topology_of(const Surface& s) {
  return topology(s, summarize(s));
}

}  // namespace

TEST_CASE("sphere_and_cube_have_genus_zero_and_a_torus_one") {
  for (const Surface& s : {test::sphere(3), test::cube()}) {
    const auto t = topology_of(s);
    REQUIRE(t);
    CHECK(t->euler == 2);
    CHECK(t->genus == 0);
    CHECK(t->boundary_loops.empty());
  }
  const auto t = topology_of(test::torus(16, 8));
  REQUIRE(t);
  CHECK(t->euler == 0);
  CHECK(t->genus == 1);
}

TEST_CASE("a_torus_without_a_ring_is_a_cylinder_with_two_loops") {
  const auto t = topology_of(test::torus(16, 8, true));
  REQUIRE(t);
  CHECK(t->genus == 0);
  CHECK(t->euler == 0);
  REQUIRE(t->boundary_loops.size() == 2);
  CHECK(t->boundary_loops[0].size() == 8);
  CHECK(t->boundary_loops[0][0] == 0);
  CHECK(t->boundary_loops[1].size() == 8);
}

TEST_CASE("a_loop_runs_with_the_surface_on_its_left") {
  const Surface s = from_triangles({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  const auto t = topology_of(s);
  REQUIRE(t);
  CHECK(t->boundary_loops == std::vector<std::vector<std::uint32_t>>{{0, 1, 2, 3}});
}

TEST_CASE("unused_vertices_and_several_parts_do_not_disturb_the_genus") {
  Surface a = test::torus(12, 6);
  const Surface b = test::moved(test::sphere(1), 0.1, 10);
  a.positions.push_back({9, 9, 9});
  const auto shift = static_cast<std::uint32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const Triangle& t : b.triangles) a.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  const auto t = topology_of(a);
  REQUIRE(t);
  CHECK(t->euler == 2);
  CHECK(t->genus == 1);
}

TEST_CASE("what_is_no_oriented_manifold_has_no_topology") {
  const std::vector<Point> p = {{0, 0, 0},  {1, 0, 0},  {0, 1, 0}, {0, 0, 1},
                                {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  SUBCASE("two closed parts joined at a vertex, in every order of their triangles") {
    std::vector<Triangle> order = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3},
                                   {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}};
    for (int turn = 0; turn < 8; ++turn) {
      std::rotate(order.begin(), order.begin() + 1, order.end());
      CHECK(!topology_of(from_triangles(p, order)));
    }
    CHECK(!topology_of(from_triangles(
        p, {{0, 2, 1}, {0, 4, 5}, {0, 1, 3}, {0, 5, 6}, {0, 3, 2}, {0, 6, 4}, {1, 2, 3}, {4, 6, 5}})));
  }
  SUBCASE("two open fans that touch at a vertex") {
    CHECK(!topology_of(from_triangles(p, {{0, 1, 2}, {0, 4, 5}})));
  }
  SUBCASE("three triangles at an edge") {
    CHECK(!topology_of(from_triangles(p, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}})));
  }
  SUBCASE("opposite orientations") {
    CHECK(!topology_of(from_triangles(p, {{0, 1, 2}, {0, 1, 3}})));
  }
  SUBCASE("a repeated corner") {
    CHECK(!topology_of(from_triangles(p, {{0, 1, 2}, {3, 3, 4}})));
  }
}
