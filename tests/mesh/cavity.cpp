#include "mesh/drawing.h"

#include "mesh/normals.h"
#include "support/shapes.h"

using namespace viete;

namespace {

// Returns the shading of a ball. `side` is 1 for normals that point outward, -1 for inward.
std::vector<float> cavity_of(const test::Surface& ball, double side, bool inside_out = false) {
  std::vector<test::Point> normals;
  for (const test::Point& p : test::sphere(3).positions) normals.push_back(side * p);
  normals.resize(ball.positions.size(), {0, 0, 1});
  return mesh::bake_cavity(ball.positions, normals, ball.triangles,
                           mesh::vertex_triangles(ball.positions.size(), ball.triangles), inside_out);
}

}  // namespace

TEST_CASE("hollows_are_darker_than_planes_and_bulges_are_not") {
  for (const float x : cavity_of(test::sphere(3), 1)) CHECK(x == 1);
  for (const float x : cavity_of(test::sphere(3), -1)) CHECK((x >= 0 && x < 0.8F));
  for (const float x : cavity_of(test::sphere(3), -1, true)) CHECK(x == 1);
  test::Surface flat = test::sphere(3);
  for (test::Point& p : flat.positions) p[2] = 0;
  const std::vector<test::Point> up(flat.positions.size(), {0, 0, 1});
  const auto around = mesh::vertex_triangles(flat.positions.size(), flat.triangles);
  for (const float x : mesh::bake_cavity(flat.positions, up, flat.triangles, around)) CHECK(x == 1);
}

TEST_CASE("cavity_ignores_stray_vertices_and_does_not_depend_on_units") {
  test::Surface ball = test::moved(test::sphere(3), 1e3);
  for (test::Point& p : ball.positions) p[0] += 5e6;
  ball.positions.push_back({9, 9, 9});
  const auto before = cavity_of(test::sphere(3), -1), after = cavity_of(ball, -1);
  for (std::size_t v = 0; v < before.size(); ++v) CHECK(after[v] == doctest::Approx(before[v]).epsilon(0.01));
  CHECK(after.back() == 1);
}
