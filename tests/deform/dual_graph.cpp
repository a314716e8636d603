#include "deform/branches.h"

#include <doctest/doctest.h>

#include "deform/shapes.h"

using namespace viete::test;
using Edges = std::vector<viete::mesh::Edge>;

namespace {

Edges path(std::uint32_t nodes) {
  Edges edges;
  for (std::uint32_t i = 0; i + 1 < nodes; ++i) edges.push_back({i, i + 1});
  return edges;
}

}  // namespace

TEST_CASE("the_centre_of_a_path_is_its_middle_and_the_lower_of_two") {
  CHECK(graph_centers(7, path(7), std::vector<std::uint8_t>(7, 0)) == std::vector<std::uint32_t>{3});
  CHECK(graph_centers(8, path(8), std::vector<std::uint8_t>(8, 0)) == std::vector<std::uint32_t>{3});
}

TEST_CASE("every_part_has_a_centre_and_skipped_elements_have_none") {
  const std::vector<std::uint8_t> skip = {0, 0, 0, 1, 0};
  CHECK(graph_centers(5, Edges{{0, 1}, {1, 2}}, skip) == std::vector<std::uint32_t>{1, 4});
}

TEST_CASE("a_long_path_beyond_the_exact_limit_has_its_middle_as_centre_too") {
  const std::uint32_t n = 20001;
  const auto centers = graph_centers(n, path(n), std::vector<std::uint8_t>(n, 0));
  CHECK(centers == std::vector<std::uint32_t>{10000});
}

TEST_CASE("a_cage_of_40000_triangles_has_its_graph_and_one_centre") {
  const auto surface = tube(200, 100, 1, 10);
  const std::vector<std::uint8_t> none(surface.triangles.size(), 0);
  const auto graph = dual_graph(surface, none);
  CHECK(graph_centers(surface.triangles.size(), graph.edges, none).size() == 1);
  CHECK(graph.edges.size() * 2 == surface.triangles.size() * 3);
}

TEST_CASE("three_triangles_on_an_edge_are_joined_in_a_chain") {
  const auto fan = viete::mesh::from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}},
                                               {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
  const auto graph = dual_graph(fan, std::vector<std::uint8_t>(3, 0));
  CHECK(graph.edges == Edges{{0, 1}, {1, 2}});
  CHECK(graph.nonmanifold == 1);
  CHECK(graph.open == 6);
}

TEST_CASE("a_triangle_collapsed_to_an_edge_leaves_its_neighbours_beside_each_other") {
  auto closed = box();
  closed.positions.push_back(closed.positions[2]);  // 8, where 2 is
  closed.triangles.push_back({0, 2, 8});
  const auto surface = viete::mesh::from_triangles(closed.positions, closed.triangles);
  std::vector<std::uint8_t> skip(surface.triangles.size(), 0);
  skip.back() = 1;
  const auto graph = dual_graph(surface, skip), sound = dual_graph(box(), std::vector<std::uint8_t>(12, 0));
  CHECK(graph.edges == sound.edges);
  CHECK(graph.open + graph.nonmanifold + graph.misoriented == 0);
}
