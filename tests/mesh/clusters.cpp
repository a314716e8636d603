#include "mesh/drawing.h"

#include <algorithm>
#include <random>

#include "mesh/summary.h"
#include "support/shapes.h"

using namespace viete;

TEST_CASE("clustered_triangles_cover_the_surface_with_about_the_wanted_number") {
  test::Surface ball = test::sphere(6);
  ball.positions.insert(ball.positions.end(), {{3, 0, 0}, {0, 0, 0}});  // two unused vertices
  const double area = mesh::summarize(ball).area;
  const auto triangles = mesh::clustered_triangles(ball, area, 2000);
  CHECK(triangles.size() > 1000);
  CHECK(triangles.size() < 4000);
  const mesh::Summary coarse = mesh::summarize(mesh::from_triangles(ball.positions, triangles));
  CHECK(coarse.boundary_edges.empty());
  CHECK(coarse.area == doctest::Approx(area).epsilon(0.05));
  CHECK(coarse.volume == doctest::Approx(4 * M_PI / 3).epsilon(0.03));
  CHECK(mesh::clustered_triangles(ball, 0, 2000).empty());
}

TEST_CASE("successive_clustered_triangles_have_common_vertices_in_any_order_of_the_model") {
  test::Surface ball = test::sphere(6);
  std::shuffle(ball.triangles.begin(), ball.triangles.end(), std::mt19937(1));
  const auto triangles = mesh::clustered_triangles(ball, mesh::summarize(ball).area, 2000);
  std::size_t common = 0;
  for (std::size_t t = 1; t < triangles.size(); ++t)
    common += std::ranges::find_first_of(triangles[t - 1], triangles[t]) != triangles[t - 1].end();
  CHECK(4 * common > 3 * triangles.size());
}
