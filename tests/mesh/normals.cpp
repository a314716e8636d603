#include "mesh/normals.h"

#include <doctest/doctest.h>

#include "mesh/shapes.h"

using namespace viete;
using namespace viete::mesh;

namespace {

std::vector<Point> normals_of(const Surface& s) {
  std::vector<Point> normals(s.positions.size());
  const Adjacency around = vertex_triangles(s.positions.size(), s.triangles);
  vertex_normals(s.positions, s.triangles, around, 0, normals.size(), normals);
  return normals;
}

}  // namespace

TEST_CASE("every_corner_of_every_triangle_is_listed_once_at_its_vertex") {
  const Surface s = test::sphere(2);
  const Adjacency around = vertex_triangles(s.positions.size(), s.triangles);
  REQUIRE(around.starts.size() == s.positions.size() + 1);
  CHECK(around.items.size() == 3 * s.triangles.size());
  for (std::size_t v = 0; v < s.positions.size(); ++v) {
    for (auto i = around.starts[v]; i < around.starts[v + 1]; ++i) {
      const Triangle& t = s.triangles[around.items[i]];
      CHECK((t[0] == v || t[1] == v || t[2] == v));
      if (i > around.starts[v]) CHECK(around.items[i] > around.items[i - 1]);
    }
  }
}

TEST_CASE("normals_of_a_sphere_point_outward_at_every_scale") {
  for (const double scale : {1e-70, 1e-30, 1.0, 1e30, 1e70}) {
    const Surface s = test::sphere(3);
    const auto normals = normals_of(test::moved(s, scale));
    for (std::size_t v = 0; v < normals.size(); ++v) {
      CHECK(dot(normals[v], normals[v]) == doctest::Approx(1).epsilon(1e-14));
      CHECK(dot(normals[v], s.positions[v]) > 0.995);
    }
  }
}

TEST_CASE("normals_are_weighted_by_area") {
  // Two perpendicular triangles at vertex 0, the one in the xy plane three times as large.
  const Surface s = from_triangles({{0, 0, 0}, {3, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 2, 3}});
  const Point n = normals_of(s)[0];
  CHECK(n[0] == doctest::Approx(1 / std::sqrt(10.0)).epsilon(1e-15));
  CHECK(n[1] == 0);
  CHECK(n[2] == doctest::Approx(3 / std::sqrt(10.0)).epsilon(1e-15));
}

TEST_CASE("a_vertex_without_area_around_it_has_a_normal_all_the_same") {
  const Surface s = from_triangles({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {9, 9, 9}}, {{0, 1, 2}, {0, 0, 1}});
  for (const Point& n : normals_of(s)) CHECK(n == Point{0, 0, 1});
}

TEST_CASE("normals_of_a_range_leave_the_others_alone_and_equal_those_of_the_whole") {
  const Surface s = test::sphere(2);
  const auto whole = normals_of(s);
  std::vector<Point> part(s.positions.size(), Point{7, 7, 7});
  vertex_normals(s.positions, s.triangles, vertex_triangles(s.positions.size(), s.triangles), 10, 20, part);
  for (std::size_t v = 0; v < part.size(); ++v)
    CHECK(part[v] == (v >= 10 && v < 20 ? whole[v] : Point{7, 7, 7}));
}
