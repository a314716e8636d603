#include "mesh/adjacency.h"

#include <doctest/doctest.h>

using namespace viete::mesh;

TEST_CASE("adjacency_lists_both_ends_of_every_edge") {
  const auto graph = adjacency(4, std::vector<Edge>{{0, 1}, {0, 2}, {1, 2}});
  CHECK(std::vector<std::uint32_t>(graph.of(0).begin(), graph.of(0).end()) ==
        std::vector<std::uint32_t>{1, 2});
  CHECK(std::vector<std::uint32_t>(graph.of(2).begin(), graph.of(2).end()) ==
        std::vector<std::uint32_t>{0, 1});
  CHECK(graph.of(3).empty());
}
