#include "deform/sparse/elimination_order.h"

#include <doctest/doctest.h>

#include <numeric>
#include <stdexcept>

#include "deform/shapes.h"
#include "deform/sparse/sparse_factor.h"

using namespace viete;
using namespace viete::test;

namespace {

using Edges = std::vector<mesh::Edge>;

Edges edges_of_grid(std::uint32_t side) {
  Edges edges;
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const auto v = y * side + x;
      if (x + 1 < side) edges.push_back({v, v + 1});
      if (y + 1 < side) edges.push_back({v, v + side});
    }
  }
  return edges;
}

Edges path_edges(std::uint32_t n) {
  Edges edges;
  for (std::uint32_t v = 0; v + 1 < n; ++v) edges.push_back({v, v + 1});
  return edges;
}

Edges star_edges(std::uint32_t n) {
  Edges edges;
  for (std::uint32_t v = 1; v < n; ++v) edges.push_back({0, v});
  return edges;
}

Edges complete_edges(std::uint32_t n) {
  Edges edges;
  for (std::uint32_t v = 0; v < n; ++v) {
    for (std::uint32_t u = 0; u < v; ++u) edges.push_back({u, v});
  }
  return edges;
}

// Two paths of different lengths, and unknowns by themselves in between.
Edges apart_edges(std::uint32_t n) {
  Edges edges;
  for (std::uint32_t v = 0; v + 3 < n / 2; v += 3) edges.push_back({v, v + 3});
  for (std::uint32_t v = n / 2; v + 1 < n; ++v) edges.push_back({v, v + 1});
  return edges;
}

bool is_permutation_of_all(std::vector<std::uint32_t> order, std::size_t n) {
  std::ranges::sort(order);
  std::vector<std::uint32_t> all(n);
  std::iota(all.begin(), all.end(), 0u);
  return order == all;
}

// Entries of the factor of the Laplacian of a grid.
std::size_t entries_of_grid(std::uint32_t side, std::size_t whole, std::size_t piece) {
  base::WorkerPool pool(1);
  std::vector<MatrixEntry> entries;
  for (std::uint32_t v = 0; v < side * side; ++v) entries.push_back({v, v, 4.5});
  for (const auto& [a, b] : edges_of_grid(side)) entries.push_back({std::max(a, b), std::min(a, b), -1});
  const SparseMatrix matrix = sparse_matrix(side * side, entries);
  const auto neighbours = neighbours_of_unknowns(matrix);
  return factor(matrix, neighbours, elimination_order(neighbours, pool, {}, whole, piece), pool)
      .values.size();
}

}  // namespace

TEST_CASE("every_unknown_is_eliminated_once_in_whatever_graph") {
  base::WorkerPool pool(2);
  for (const std::uint32_t n : {1u, 2u, 3u, 10u, 64u, 400u}) {
    for (const Edges& edges :
         {Edges{}, path_edges(n), star_edges(n), complete_edges(std::min(n, 64u)), apart_edges(n)}) {
      const mesh::Adjacency graph = mesh::adjacency(n, edges);
      for (const std::size_t piece : {1u, 2u, 7u, 50u, 1000u}) {
        CAPTURE(n);
        CAPTURE(piece);
        CHECK(is_permutation_of_all(elimination_order(graph, pool, {}, 0, piece), n));
      }
    }
  }
  CHECK(elimination_order(mesh::adjacency(0, {}), pool).empty());
}

TEST_CASE("the_order_is_the_same_for_any_number_of_threads") {
  const mesh::Adjacency grid = mesh::adjacency(40 * 40, edges_of_grid(40));
  base::WorkerPool one(1), two(2), three(3);
  const auto order = elimination_order(grid, one, {}, 0, 20);
  CHECK(is_permutation_of_all(order, 40 * 40));
  CHECK(elimination_order(grid, two, {}, 0, 20) == order);
  CHECK(elimination_order(grid, three, {}, 0, 20) == order);
}

TEST_CASE("dissection_fills_in_little") {
  const std::size_t dissected = entries_of_grid(100, 0, 100);
  CHECK(dissected < 1.05 * double(entries_of_grid(100, 10'000, 100)));
  CHECK(dissected < 31 * 100 * 100 * std::log2(100) / 4);  // as George's: 7.75 n log2 n for n = side squared
}

TEST_CASE("an_order_is_made_no_further_once_it_is_told_to_stop") {
  const mesh::Adjacency grid = mesh::adjacency(40 * 40, edges_of_grid(40));
  base::WorkerPool pool(1);
  for (const int last : {1, 2, 10, 100}) {
    int calls = 0;
    const auto stop = [&](double done) {
      CHECK(done >= 0);
      CHECK(done <= 1);
      if (++calls == last) throw std::runtime_error("enough");
    };
    CHECK_THROWS_AS(elimination_order(grid, pool, stop, 0, 20), std::runtime_error);
    CHECK(calls == last);
  }
}
