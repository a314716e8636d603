#include "cages/soundness.h"
#include "cages/models.h"
#include "cages/subject.h"
#include "mesh/summary.h"

using namespace viete;
using namespace viete::test;

namespace {

void check_closed_manifold(const cages::Shell& shell) {
  const mesh::Surface s = mesh::from_triangles(shell.positions, shell.triangles);
  const mesh::Summary summary = mesh::summarize(s);
  CHECK(summary.closed());
  CHECK(mesh::topology(s, summary));
  CHECK(summary.degenerate_polygons.empty());
  CHECK(summary.volume > 0);
}

}  // namespace

TEST_CASE("extracted_surface_of_random_values_is_a_closed_oriented_manifold") {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<float> value(-1, 1);
  for (const bool mirrored : {false, true})
    for (int i = 0; i < 20; ++i) {
      cages::Grid grid{{0, 0, 0}, 1, {9, 8, 10}, mirrored};
      std::vector<float> values(grid.node_count(), 1);
      for (std::size_t x = mirrored ? 0 : 1; x + 1 < grid.size[0]; ++x)
        for (std::size_t y = 1; y + 1 < grid.size[1]; ++y)
          for (std::size_t z = 1; z + 1 < grid.size[2]; ++z) values[grid.index(x, y, z)] = value(engine);
      const cages::Shell shell = cages::extract({grid, values}, 0);
      check_closed_manifold(mirrored ? cages::whole(shell) : shell);
    }
}

TEST_CASE("clearance_is_positive_outside_and_negative_inside") {
  base::WorkerPool pool(2);
  for (const auto& model : {sphere(4), without_lower_half(sphere(4)), shaken(sphere(4), 1e-3)}) {
    const mesh::TriangleTree tree(model.positions, model.triangles);
    const bool closed = mesh::summarize(model).closed();
    const cages::Grid grid = cages::grid_around(mesh::bounds(model.positions), 30, 0.3, false);
    const auto field = cages::clearance({tree, closed}, grid, {0.1, 0.02}, pool);
    for (const Point& p : {Point{0, 0, 1.2}, Point{1.15, 0, 0.1}, Point{-0.7, 0.7, 0.7}}) {
      const double distance = std::sqrt(tree.nearest(p).squared_distance);
      CHECK(std::abs(field.at(p) - distance) < 0.02);
    }
    if (closed) CHECK(field.at(Point{0, 0, 0}) < 0);
    CHECK(field.at(Point{0, 0, 50}) > 10);
    CHECK(field.at(Point{0, 0, 50}) <= 50);
  }
}

TEST_CASE("triangle_is_clear_if_all_samples_keep_the_margin") {
  base::WorkerPool pool(1);
  const mesh::Surface model = sphere(4);
  const mesh::TriangleTree tree(model.positions, model.triangles);
  const cages::Grid grid = cages::grid_around(mesh::bounds(model.positions), 40, 0.5, false);
  const auto field = cages::clearance({tree, true}, grid, {0.3, 0}, pool);
  const auto above = [](double z) { return mesh::Corners{{{-1.2, -1.2, z}, {1.2, -1.2, z}, {0, 1.4, z}}}; };
  CHECK(field.is_clear(above(1.3), 0.2));
  CHECK_FALSE(field.is_clear(above(1.3), 0.4));
  CHECK_FALSE(field.is_clear(above(0.9), 0.01));  // the corners are clear, but the centre is not
}
