#include "cages/extraction.h"

#include <doctest/doctest.h>

#include "cages/make.h"
#include "cages/models.h"
#include "mesh/summary.h"

using namespace viete;
using namespace viete::test;

TEST_CASE("the_triangles_of_a_cube_pair_to_its_sides") {
  const mesh::Surface box = cube();
  const cages::Shell shell{box.positions, box.triangles};
  const auto pairs = cages::quad_pairs(shell);
  CHECK(pairs.size() == 6);
  const mesh::Surface quads = cages::with_quads(shell, pairs);
  check_invariants(quads);
  CHECK(quads.polygon_count() == 6);
  CHECK(mesh::summarize(quads).volume == doctest::Approx(8));
}

TEST_CASE("no_triangle_is_in_two_pairs_and_none_is_lost") {
  const mesh::Surface ball = sphere(3);
  const cages::Shell shell{ball.positions, ball.triangles};
  const auto pairs = cages::quad_pairs(shell);
  std::vector<int> taken(ball.triangles.size(), 0);
  for (const auto& [s, t] : pairs) {
    ++taken[s];
    ++taken[t];
  }
  CHECK(std::ranges::max(taken) == 1);
  const mesh::Surface quads = cages::with_quads(shell, pairs);
  check_invariants(quads);
  auto before = ball.triangles, after = quads.triangles;
  const auto from_least = [](auto& triangles) {
    for (auto& t : triangles) std::ranges::rotate(t, std::ranges::min_element(t));
    std::ranges::sort(triangles);
  };
  from_least(before);
  from_least(after);
  CHECK(before == after);
}

TEST_CASE("triangles_across_a_sharp_edge_make_no_quad") {
  // A tetrahedron.
  CHECK(cages::quad_pairs(
            {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}})
            .empty());
}

TEST_CASE("cages_with_quads_are_mostly_quads") {
  base::WorkerPool pool(2);
  for (const auto& model : {stool(), sphere(3)}) {
    const auto made = cages::make(model, {.triangles = 200, .quads = true}, pool);
    const std::size_t quads = made.surface.triangles.size() - made.surface.polygon_count();
    CHECK(4 * quads > made.surface.triangles.size());  // half of the triangles or more
  }
}
