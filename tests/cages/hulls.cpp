#include "cages/hull.h"

#include <doctest/doctest.h>

#include "cages/judge.h"
#include "cages/models.h"
#include "mesh/orientation.h"
#include "mesh/triangle.h"

using namespace viete;
using namespace viete::test;

namespace {

mesh::Surface surface_of(const cages::Shell& shell) {
  return mesh::from_triangles(shell.positions, shell.triangles);
}

void check_hull(const std::vector<Point>& points, double margin) {
  const mesh::Surface hull = surface_of(cages::hull(points, margin));
  const mesh::Summary summary = mesh::summarize(hull);
  const auto topology = mesh::topology(hull, summary);
  REQUIRE(topology);
  CHECK(summary.closed());
  CHECK(topology->genus == 0);
  CHECK(summary.volume > 0);
  double least = HUGE_VAL;
  bool within = true;
  for (const auto& t : hull.triangles) {
    const mesh::Corners c = corners_of(hull, t);
    for (const Point& p : points) {
      within = within && mesh::orientation(c[0], c[1], c[2], p) < 0;
      least = std::min(least, mesh::closest_on_triangle(p, c[0], c[1], c[2]).squared_distance);
    }
    for (const Point& p : hull.positions) within = within && mesh::orientation(c[0], c[1], c[2], p) <= 0;
  }
  CHECK(within);
  CHECK(std::sqrt(least) >= margin * (1 - 1e-9));
}

}  // namespace

TEST_CASE("hulls_are_convex_and_around_all_points") {
  check_hull(soup(40, 0.3, 1).positions, 0.01);
  check_hull(sphere(2).positions, 0.1);
  check_hull(cube().positions, 1e-6);                                    // many in each plane
  check_hull(sheet(4, [](int, int) { return false; }).positions, 0.01);  // all in one
  check_hull({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {0.5, 0.5, 0.5}}, 0.01);  // on a line
  check_hull({{3, 4, 5}}, 0.5);
  check_hull({{0.5, 0.5, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0.5, 1}}, 0.001);
}

TEST_CASE("a_hull_of_many_points_on_a_circle_and_two_above_is_quick") {
  std::vector<Point> points = needles(20'000).positions;
  const cages::Shell hull = cages::convex(points);
  CHECK(hull.positions.size() == points.size());
  CHECK(hull.triangles.size() == 2 * points.size() - 4);
}
