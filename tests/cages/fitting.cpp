// Fitting cages to models, and moving single vertices out of models.
#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "cages/enclose.h"
#include "cages/make.h"
#include "cages/models.h"
#include "mesh/formats/read.h"
#include "mesh/triangle_tree.h"
#include "mesh/winding_number.h"
#include "support/data.h"

using namespace viete;
using namespace viete::test;

namespace {

constexpr double margin = 0.01;

// Three arms of different lengths: no symmetry.
Surface three_arms() {
  return of_cells(9, [](int i, int j, int k) {
    return (i < 2 && j < 2) || (k < 2 && j < 2 && i < 6) || (i < 2 && k < 3 && j < 4);
  });
}

struct Placement {
  Eigen::Quaterniond turn;
  double scale;
  Eigen::Vector3d shift;

  double degrees() const { return Eigen::AngleAxisd(turn).angle() * 180 / std::numbers::pi; }
};

std::vector<Placement> odd_placements() {
  return {{{0.3, 0.8, -0.4, 0.33}, 3, {10, -20, 5}},   {{0.9, 0.1, 0.4, -0.1}, 0.01, {0, 0, 0}},
          {{0.05, -0.6, 0.2, 0.77}, 1, {0.1, 0.2, 0}}, {{-0.5, 0.5, 0.49, 0.52}, 1e6, {1e7, 1e7, 0}},
          {{0.7, 0, 0.714, 0}, 0.5, {3, 0, -4}},       {{0.99, 0.02, -0.4, 0.3}, 1.3, {1, 1, 1}}};
}

// The displacement in diagonals of the surface.
Surface placed(Surface surface, const Placement& to) {
  const double size = mesh::used_bounds(surface).diagonal();
  for (Point& p : surface.positions) {
    const Eigen::Vector3d x =
        to.scale * (to.turn.normalized() * Eigen::Vector3d(p[0], p[1], p[2])) + size * to.shift;
    p = {x[0], x[1], x[2]};
  }
  return surface;
}

// Root mean square of vertex distances, in model diagonals.
double distance(const std::vector<Point>& a, const std::vector<Point>& b, const Surface& model) {
  double sum = 0;
  for (std::size_t v = 0; v < a.size(); ++v) sum += mesh::squared_norm(a[v] - b[v]);
  return std::sqrt(sum / static_cast<double>(a.size())) / mesh::used_bounds(model).diagonal();
}

bool is_outside(const Point& p, const mesh::TriangleTree& tree, double least) {
  return std::abs(tree.winding_number(p)) < 0.5 && tree.nearest(p).squared_distance >= least * least;
}

}  // namespace

TEST_CASE("best_fit_restores_orientation_size_and_place") {
  base::WorkerPool pool(2);
  const Surface model = three_arms();
  const Surface cage = cages::make(model, {.triangles = 120}, pool).surface;
  for (const Placement& to : odd_placements()) {
    CAPTURE(to.scale);
    const cages::Fitted fitted = cages::best_fit(placed(cage, to), model, margin);
    CHECK(distance(fitted.positions, cage.positions, model) < 0.05);
    CHECK(fitted.degrees == doctest::Approx(to.degrees()).epsilon(0.05));
  }
}

TEST_CASE("best_fit_restores_manual_cages" * doctest::test_suite(if_present)) {
  for (const char* name : {"armadillo-man", "arm", "hand", "octopus", "horse", "spot"}) {
    const auto folder = shared_data(name);
    if (folder.empty()) return;
    CAPTURE(name);
    const Surface model = mesh::read(folder / "mesh.obj").surface,
                  cage = mesh::read(folder / "cage.obj").surface;
    for (const Placement& to : odd_placements()) {
      CAPTURE(to.scale);
      const cages::Fitted fitted = cages::best_fit(placed(cage, to), model, margin);
      CHECK(distance(fitted.positions, cage.positions, model) < 0.1);
      CHECK(std::abs(fitted.degrees - to.degrees()) < 12);
    }
  }
}

TEST_CASE("best_fit_does_not_rotate_a_moved_and_scaled_cage") {
  base::WorkerPool pool(2);
  for (const Surface& model : {three_arms(), stool(), torus(30, 12)}) {
    Surface cage = cages::make(model, {.triangles = 60}, pool).surface;
    cage = placed(std::move(cage), {Eigen::Quaterniond::Identity(), 0.3, {4, 5, 6}});
    const cages::Fitted fitted = cages::best_fit(cage, model, margin);
    CHECK(fitted.degrees == 0);
    CHECK(fitted.positions == cages::fitted_to_box(cage, model, margin).positions);
  }
}

TEST_CASE("fitted_cage_encloses_the_box_by_a_deterministic_similarity") {
  base::WorkerPool pool(2);
  const Surface model = three_arms();
  const mesh::Bounds box = mesh::used_bounds(model);
  const Surface made = cages::make(model, {.triangles = 80}, pool).surface;
  for (const std::size_t i : {0, 3}) {
    const Surface cage = placed(made, odd_placements()[i]);
    const cages::Fitted fitted = cages::best_fit(cage, model, margin);
    CHECK(fitted.positions == cages::best_fit(cage, model, margin).positions);
    const mesh::Bounds now = mesh::bounds(fitted.positions);
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(now.high[k] - now.low[k] >=
            doctest::Approx(box.high[k] - box.low[k] + 2 * margin * box.diagonal()));
      CHECK(0.5 * (now.high[k] + now.low[k]) == doctest::Approx(box.center()[k]));
    }
    for (std::size_t v = 1; v < cage.positions.size(); ++v) {
      const Point way = cage.positions[v] - cage.positions[0],
                  went = fitted.positions[v] - fitted.positions[0];
      for (std::size_t k = 0; k < 3; ++k)
        CHECK(mesh::dot(fitted.linear[k], way) == doctest::Approx(went[k]).epsilon(1e-6));
    }
  }
}

TEST_CASE("fitted_cages_are_finite_for_any_model" * doctest::test_suite(longer)) {
  const Surface cage = placed(three_arms(), {{0.3, 0.8, -0.4, 0.33}, 2, {1, 0, 0}});
  for (const auto& [name, model] : generated_models()) {
    CAPTURE(name);
    for (const Point& p : cages::best_fit(cage, model, margin).positions)
      REQUIRE(std::isfinite(mesh::largest_abs(p)));
  }
  const Surface flat = stretched(cube(), {1, 0.7, 0});
  for (const Point& p : cages::best_fit(flat, three_arms(), margin).positions)
    REQUIRE(std::isfinite(mesh::largest_abs(p)));
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
