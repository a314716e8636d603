// Fitting cages to models, and moving single vertices out of models.
#include <doctest/doctest.h>

#include "cages/enclose.h"
#include "cages/models.h"
#include "mesh/triangle_tree.h"

using namespace viete;
using namespace viete::test;

namespace {

constexpr double margin = 0.01;

bool is_outside(const Point& p, const mesh::TriangleTree& tree, double least) {
  return std::abs(tree.winding_number(p)) < 0.5 && tree.nearest(p).squared_distance >= least * least;
}

}  // namespace

TEST_CASE("fitted_cage_encloses_the_box_with_the_same_shape") {
  const Surface model = stool(), cage = stretched(torus(8, 6), {3, 2, 0.5}, {10, -20, 5});
  const mesh::Bounds box = mesh::used_bounds(model);
  const cages::Fitted fitted = cages::fitted_to_box(cage, model, margin);
  const mesh::Bounds now = mesh::bounds(fitted.positions);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(now.high[k] - now.low[k] >=
          doctest::Approx(box.high[k] - box.low[k] + 2 * margin * box.diagonal()));
    CHECK(0.5 * (now.high[k] + now.low[k]) == doctest::Approx(box.center()[k]));
  }
  for (std::size_t v = 1; v < cage.positions.size(); ++v) {
    const Point way = fitted.scale * (cage.positions[v] - cage.positions[0]);
    CHECK(mesh::norm(fitted.positions[v] - fitted.positions[0] - way) < 1e-9);
  }
}

TEST_CASE("snap_outside_moves_only_inside_or_near_vertices") {
  for (const auto& [name, model] : generated_models()) {
    const bool one_side = name == "torus" || name == "sphere" || name == "stool" || name == "spikes" ||
                          name == "comb" || name == "coil" || name == "inside out" || name == "turned plate";
    if (!one_side) continue;
    CAPTURE(name);
    const mesh::Bounds box = mesh::used_bounds(model);
    const double least = 0.998 * margin * box.diagonal();
    Surface cage = soup(100, 0.5, 3);
    for (Point& p : cage.positions) {
      for (std::size_t k = 0; k < 3; ++k) p[k] = box.center()[k] + 0.5 * (box.high[k] - box.low[k]) * p[k];
    }
    cage.positions[0] = model.positions[model.triangles[0][0]];  // on the surface
    std::vector<std::uint32_t> some;
    for (std::uint32_t v = 0; v < cage.positions.size(); v += 2) some.push_back(v);
    const cages::SnappedOutside snapped = cages::snap_outside(cage, some, model, margin);

    const mesh::TriangleTree tree(model.positions, model.triangles);
    std::size_t within = 0, moved = 0;
    for (std::uint32_t v = 0; v < cage.positions.size(); ++v) {
      const Point &before = cage.positions[v], &now = snapped.positions[v];
      if (v % 2 == 1 || is_outside(before, tree, margin * box.diagonal())) CHECK(now == before);
      if (v % 2 == 0 && !is_outside(now, tree, least)) ++within;
      if (now != before) ++moved;
    }
    CHECK(moved > 0);
    CHECK(snapped.moved == moved);
    CHECK(snapped.left == within);
    CHECK(snapped.left <= some.size() / 20);
  }
}

TEST_CASE("snap_outside_takes_the_shortest_way") {
  const Surface model = cube();  // half a side is 1, its diagonal 2 sqrt(3)
  const double beyond = margin * 2 * std::sqrt(3.0);
  Surface cage = model;
  cage.positions[0] = {0.9, 0.1, -0.2};
  cage.positions[1] = {0.1, 1, -0.2};                // on a side
  cage.positions[2] = {0.3, 0.2, 1 + 0.5 * beyond};  // too near
  const auto out = cages::snap_outside(cage, std::vector<std::uint32_t>{0, 1, 2}, model, margin).positions;
  CHECK(mesh::norm(out[0] - Point{1 + beyond, 0.1, -0.2}) < 1e-9);
  CHECK(mesh::norm(out[1] - Point{0.1, 1 + beyond, -0.2}) < 1e-9);
  CHECK(mesh::norm(out[2] - Point{0.3, 0.2, 1 + beyond}) < 1e-9);
}
