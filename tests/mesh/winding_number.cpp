#include "mesh/winding_number.h"

#include "support/shapes.h"

using namespace viete;
using namespace viete::mesh;

namespace {

// Computes the formula of Van Oosterom and Strackee in long double, with one arc tangent per triangle.
double by_arc_tangents(const Surface& s, const Point& p) {
  using Real = long double;
  Real sum = 0;
  for (const Triangle& t : s.triangles) {
    Real r[3][3], length[3];
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) r[i][k] = Real{s.positions[t[i]][k]} - Real{p[k]};
      length[i] = std::sqrt(r[i][0] * r[i][0] + r[i][1] * r[i][1] + r[i][2] * r[i][2]);
    }
    const auto dot = [&](int i, int j) { return r[i][0] * r[j][0] + r[i][1] * r[j][1] + r[i][2] * r[j][2]; };
    const Real det = r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) -
                     r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
                     r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
    sum += std::atan2(det, length[0] * length[1] * length[2] + dot(0, 1) * length[2] + dot(1, 2) * length[0] +
                               dot(2, 0) * length[1]);
  }
  return static_cast<double>(sum / (2 * std::acos(Real{-1})));
}

}  // namespace

TEST_CASE("a_closed_surface_winds_once_around_the_inside_and_not_around_the_outside") {
  for (const double scale : {1e-100, 1e-30, 1.0, 1e30, 1e100}) {
    const Surface s = test::moved(test::cube(), scale);
    CHECK(winding_number(s, {0, 0, 0}) == doctest::Approx(1).epsilon(1e-14));
    CHECK(winding_number(s, {0.999 * scale, 0.3 * scale, -0.9 * scale}) == doctest::Approx(1).epsilon(1e-12));
    CHECK(std::abs(winding_number(s, {1.001 * scale, 0.3 * scale, 0})) < 1e-12);
    CHECK(std::abs(winding_number(s, {1e3 * scale, 0, 0})) < 1e-12);
  }
}

TEST_CASE("winding_numbers_agree_with_a_sum_of_arc_tangents") {
  Surface open = test::sphere(2), twice = test::sphere(2), inside_out = test::cube();
  open.triangles.resize(100);
  for (const Triangle t : test::sphere(2).triangles) twice.triangles.push_back(t);
  for (Triangle& t : inside_out.triangles) std::swap(t[1], t[2]);
  for (const Surface& s : {test::sphere(3), test::torus(20, 10), open, twice, inside_out}) {
    const auto points = test::Random(7).vectors(203, 3);
    base::WorkerPool pool(3);
    const auto outside = points_outside(s, points);
    CHECK(outside == points_outside(s, points, &pool));
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      const double number = by_arc_tangents(s, points[i]);
      CHECK(std::abs(winding_number(s, points[i]) - number) < 1e-12);
      CHECK(std::ranges::binary_search(outside, i) == (std::abs(number) < 0.5));
    }
  }
}

TEST_CASE("points_outside_are_those_beyond_the_cage") {
  const auto points = test::Random(7).vectors(2000, 1.5);
  Surface cage = test::cube();
  for (int orientation = 0; orientation < 2; ++orientation) {
    const auto outside = points_outside(cage, points);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      const Point& p = points[i];
      if (std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}) > 1) expected.push_back(i);
    }
    CHECK(outside == expected);
    CHECK(outside.size() > 1000);
    for (Triangle& t : cage.triangles) std::swap(t[1], t[2]);
  }
}

TEST_CASE("points_on_the_cage_are_not_outside") {
  const Surface cage = test::cube();
  CHECK(points_outside(cage, cage.positions).empty());
  std::vector<Point> points = {{1, 0, 0},       {0, 0, -1},      {1, 1, 0.3},
                               {0.25, 0.25, 1}, {-1, 0.1, -0.7}, {1 + 1e-11, 0, 0}};
  CHECK(points_outside(cage, points).empty());
  points = {{1 + 1e-6, 0, 0}, {1, 1, 1.0001}, {1, 1.5, 0}};
  CHECK(points_outside(cage, points).size() == 3);
  const Surface sphere = test::sphere(3);
  CHECK(points_outside(sphere, sphere.positions).empty());
}

TEST_CASE("every_point_is_outside_of_an_empty_cage") {
  CHECK(points_outside(test::cube(), {}).empty());
  const std::vector<Point> points = {{0, 0, 0}, {1, 2, 3}};
  CHECK(points_outside(Surface{}, points).size() == 2);
}
