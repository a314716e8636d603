#include "bench/torn.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace viete;

TEST_CASE("what_is_torn_is_the_largest_change_of_distance_of_near_vertices_that_nothing_joins") {
  // Two squares 0.005 apart, of a model whose diagonal is nearly 1.
  const double side = std::sqrt(0.5);
  const std::vector<mesh::Point> rest = {{0, 0, 0},           {side, 0, 0},    {side, side, 0},
                                         {0, side, 0},        {0, 0, 0.005},   {side, 0, 0.005},
                                         {side, side, 0.005}, {0, side, 0.005}};
  const mesh::Surface model = mesh::from_triangles(rest, {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}});
  base::WorkerPool pool(2);
  auto pairs = bench::near_pairs(model, pool);
  CHECK(pairs.size() == 8);  // from either side
  std::vector<mesh::Point> posed = rest;
  for (auto& p : posed) p = {p[1] + 3, -p[0], p[2]};
  CHECK(bench::torn(pairs, rest, posed) < 1e-12);
  posed[6][2] += 0.1;
  CHECK(bench::torn(pairs, rest, posed) == doctest::Approx(0.1).epsilon(1e-3));
  posed[6][2] = NAN;
  CHECK(std::isnan(bench::torn(pairs, rest, posed)));
  CHECK(bench::near_pairs(mesh::from_triangles(rest, {{0, 1, 2}, {0, 2, 3}}), pool).empty());
}
