#include "mesh/surface.h"

#include "support/shapes.h"

using namespace viete;
using namespace viete::mesh;

TEST_CASE("a_surface_of_triangles_has_them_as_polygons") {
  const Surface s = from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {3, 2, 1}});
  test::check_invariants(s);
  CHECK(s.polygon_count() == 2);
  CHECK(s.corners == std::vector<std::uint32_t>{0, 1, 2, 3, 2, 1});
  CHECK(s.triangle_polygon == std::vector<std::uint32_t>{0, 1});
}

TEST_CASE("a_surface_without_anything_has_no_polygons_and_an_empty_box") {
  Surface s;
  triangulate(s);
  CHECK(s.polygon_count() == 0);
  CHECK(s.triangles.empty());
  CHECK(bounds(s.positions).diagonal() == 0);
  CHECK(used_bounds(s).center() == Point{0, 0, 0});
}

TEST_CASE("bounds_contain_all_vertices_and_used_bounds_those_of_polygons") {
  Surface s = test::cube();
  s.positions.push_back({100, -7, 3});
  CHECK(bounds(s.positions).high == Point{100, 1, 3});
  CHECK(bounds(s.positions).low == Point{-1, -7, -1});
  CHECK(used_bounds(s).high == Point{1, 1, 1});
  CHECK(used_bounds(s).diagonal() == doctest::Approx(std::sqrt(12.0)).epsilon(1e-15));
  s.corners.clear();
  CHECK(used_bounds(s).high == Point{100, 1, 3});
}

TEST_CASE("the_box_of_huge_and_tiny_coordinates_has_a_finite_centre_and_diagonal") {
  for (const double scale : {1e-100, 1e-30, 1e30, 1e100}) {
    const Bounds box = bounds(test::moved(test::cube(), scale).positions);
    CHECK(box.center() == Point{0, 0, 0});
    CHECK(box.diagonal() == doctest::Approx(std::sqrt(12.0) * scale).epsilon(1e-14));
  }
}

TEST_CASE("used_size_of_a_box_is_its_diagonal_in_any_orientation") {
  const Surface cube = viete::test::cube();
  CHECK(used_size(cube) == doctest::Approx(used_bounds(cube).diagonal()).epsilon(1e-15));
  CHECK(used_size(Surface{}) == 0);
  Surface points;
  points.positions = {{0, 0, 0}, {0, 0, 4}};
  CHECK(used_size(points) == 4);
  points.positions = {{-1e100, 0, 0}, {1e100, 0, 0}, {0, 1e100, 0}};
  points.corners = {0, 1, 2};
  points.polygon_starts = {0, 3};
  triangulate(points);
  CHECK(used_size(points) == doctest::Approx(2e100 * std::sqrt(10.0) / 3).epsilon(1e-14));
}

TEST_CASE("cross_products_of_swapped_vectors_are_opposite_to_the_last_bit") {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int n = 0; n < 1000; ++n) {
    const Vec3 a{number(engine), number(engine), number(engine)};
    const Vec3 b{number(engine), number(engine), number(engine)};
    CHECK(cross(a, b) == -1.0 * cross(b, a));
  }
}

TEST_CASE("lengths_of_any_scale_are_measured") {
  for (const double scale : {1e-300, 1.0, 1e300}) {
    CHECK(stable_norm({2 * scale, -3 * scale, 6 * scale}) == doctest::Approx(7 * scale));
    CHECK(largest_abs({2 * scale, -3 * scale, 1 * scale}) == 3 * scale);
  }
  CHECK(norm({2, -3, 6}) == 7);
}
