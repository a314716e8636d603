#include "mesh/drawing.h"

#include "mesh/normals.h"
#include "mesh/summary.h"
#include "support/shapes.h"

using namespace viete;

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
