#include "mesh/cavity.h"

#include <cmath>

#include "shapes.h"

using namespace viete;
using test::Point;

namespace {

struct Sheet {
  std::vector<Point> positions, normals;
  std::vector<test::Triangle> triangles;
};

/// A square sheet of n x n vertices with a valley of Gaussian section along x = 0 (depth > 0) or a ridge
/// (depth < 0).
Sheet sheet(std::uint32_t n, double depth) {
  Sheet result;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const double x = 2.0 * j / (n - 1) - 1, y = 2.0 * i / (n - 1) - 1;
      const double valley = -depth * std::exp(-25 * x * x), slope = 50 * x * depth * std::exp(-25 * x * x);
      const double length = std::sqrt(1 + slope * slope);
      result.positions.push_back({x, y, valley});
      result.normals.push_back({-slope / length, 0, 1 / length});
    }
  }
  for (std::uint32_t i = 0; i + 1 < n; ++i) {
    for (std::uint32_t j = 0; j + 1 < n; ++j) {
      const std::uint32_t a = i * n + j;
      result.triangles.push_back({a, a + 1, a + n + 1});
      result.triangles.push_back({a, a + n + 1, a + n});
    }
  }
  return result;
}

float middle(const Sheet& mesh, std::uint32_t n) {
  return mesh::bake_cavity(mesh.positions, mesh.normals, mesh.triangles)[n / 2 * n + n / 2];
}

}  // namespace

TEST_CASE("valleys_are_darker_than_planes_and_ridges_are_not") {
  const float valley = middle(sheet(41, 0.2), 41), flat = middle(sheet(41, 0), 41),
              ridge = middle(sheet(41, -0.2), 41);
  CHECK(flat == doctest::Approx(1));
  CHECK(ridge == doctest::Approx(1));
  CHECK(valley < 0.8F);
}

TEST_CASE("cavity_does_not_depend_on_units") {
  Sheet mesh = sheet(41, 0.2);
  const std::vector<float> before = mesh::bake_cavity(mesh.positions, mesh.normals, mesh.triangles);
  for (Point& p : mesh.positions) p = {1e3 * p[0] + 5e6, 1e3 * p[1], 1e3 * p[2]};
  const std::vector<float> after = mesh::bake_cavity(mesh.positions, mesh.normals, mesh.triangles);
  for (std::size_t v = 0; v < before.size(); ++v) CHECK(after[v] == doctest::Approx(before[v]).epsilon(0.01));
}

TEST_CASE("cavity_lies_between_0_and_1_and_ignores_stray_vertices") {
  Sheet mesh = sheet(21, 0.6);
  mesh.positions.push_back({9, 9, 9});
  mesh.normals.push_back({0, 0, 1});
  const std::vector<float> cavity = mesh::bake_cavity(mesh.positions, mesh.normals, mesh.triangles);
  for (const float value : cavity) {
    CHECK(value >= 0);
    CHECK(value <= 1);
  }
  CHECK(cavity.back() == 1);
}
