#include "mesh/drawing.h"

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
