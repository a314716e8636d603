#include "mesh/drawing.h"

#include <doctest/doctest.h>
#include <random>

#include "mesh/normals.h"
#include "mesh/summary.h"
#include "support/shapes.h"

using namespace viete;

TEST_CASE("spacing_of_points_is_the_root_of_the_area_per_point") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> even;
  for (const std::size_t count : {100U, 5000U, 100'000U}) {
    std::vector<mesh::Point> points;
    for (std::size_t i = 0; i < count; ++i) points.push_back({4 * even(random), 9 * even(random), 1e3});
    const double exact = std::sqrt(36.0 / static_cast<double>(count));
    CHECK(mesh::point_spacing(points) == doctest::Approx(exact).epsilon(0.15));
    for (std::size_t i = 0; i < count; i += 50) points[i] = {1e6 * even(random), 0, 0};  // lonely points
    CHECK(mesh::point_spacing(points) == doctest::Approx(exact).epsilon(0.2));
  }
  CHECK(mesh::point_spacing({}) == 0);
  CHECK(mesh::point_spacing(std::vector<mesh::Point>(1)) == 0);
  CHECK(mesh::point_spacing(std::vector<mesh::Point>(100)) == 0);
}

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

namespace {

mesh::Draft draft_of(const mesh::Surface& surface, double area, std::size_t wanted) {
  std::vector<mesh::Point> normals(surface.positions.size());
  mesh::vertex_normals(surface.positions, surface.triangles,
                       mesh::vertex_triangles(normals.size(), surface.triangles), 0, normals.size(), normals);
  return mesh::draft_of(surface, normals, mesh::used_bounds(surface), area, wanted);
}

}  // namespace

TEST_CASE("a_draft_covers_the_surface_with_about_the_wanted_number_of_triangles") {
  test::Surface ball = test::sphere(6);
  const auto unused = static_cast<std::uint32_t>(ball.positions.size());
  for (const double x : {3.0, 0.0, 0.99, 0.98}) ball.positions.push_back({x, 0, 0});
  const double area = mesh::summarize(ball).area;
  const mesh::Draft draft = draft_of(ball, area, 2000);
  CHECK(draft.surface.triangles.size() > 1000);
  CHECK(draft.surface.triangles.size() < 4000);
  CHECK(*std::ranges::max_element(draft.vertices) < unused);
  CHECK(draft.surface.positions ==
        mesh::picked(std::span<const mesh::Point>(ball.positions), draft.vertices));
  const mesh::Summary coarse = mesh::summarize(draft.surface);
  CHECK(coarse.boundary_edges.empty());
  CHECK(coarse.area == doctest::Approx(area).epsilon(0.05));
  CHECK(coarse.volume == doctest::Approx(4 * M_PI / 3).epsilon(0.03));
  CHECK(draft_of(ball, 0, 2000).surface.triangles.empty());
}

TEST_CASE("successive_triangles_of_a_draft_have_common_vertices_in_any_order_of_the_model") {
  test::Surface ball = test::sphere(6);
  std::shuffle(ball.triangles.begin(), ball.triangles.end(), std::mt19937(1));
  const auto triangles = draft_of(ball, mesh::summarize(ball).area, 2000).surface.triangles;
  std::size_t common = 0;
  for (std::size_t t = 1; t < triangles.size(); ++t)
    common += std::ranges::find_first_of(triangles[t - 1], triangles[t]) != triangles[t - 1].end();
  CHECK(4 * common > 3 * triangles.size());
}

TEST_CASE("the_sides_of_a_thin_part_stay_apart_in_a_draft") {
  test::Surface plate = test::sphere(6);
  for (auto& p : plate.positions) p[2] *= 0.001;
  const mesh::Surface draft = draft_of(plate, mesh::summarize(plate).area, 500).surface;
  std::vector<mesh::Point> normals(draft.positions.size());
  mesh::vertex_normals(draft.positions, draft.triangles,
                       mesh::vertex_triangles(normals.size(), draft.triangles), 0, normals.size(), normals);
  std::size_t wrong = 0;
  for (std::size_t v = 0; v < normals.size(); ++v)
    wrong += std::abs(draft.positions[v][2]) > 5e-4 && normals[v][2] * draft.positions[v][2] < 0;
  CHECK(normals.size() > 100);
  CHECK(wrong == 0);
}
