// Manual edits of cages with concave polygons. The surface must stay connected and have the right volume.
#include "cages/edit.h"
#include "cages/enclose.h"

#include "cages/soundness.h"
#include "mesh/summary.h"
#include "support/shapes.h"

using namespace viete;
using mesh::Point, mesh::Surface;

namespace {

constexpr std::array<std::array<double, 2>, 8> outline = {
    {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}};
constexpr double volume = 7;

// Returns a U-shape of thickness 1. It has two caps with eight corners each, and quads between the caps.
Surface letter_u() {
  std::string text;
  const auto corner = [](std::size_t i, int cap) { return std::to_string(i + 1 + 8 * cap) + " "; };
  for (int cap = 0; cap < 2; ++cap)
    for (const auto& [x, y] : outline)
      text += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(cap) + "\n";
  text += "f ";
  for (std::size_t i = 8; i-- > 0;) text += corner(i, 0);
  text += "\nf ";
  for (std::size_t i = 0; i < 8; ++i) text += corner(i, 1);
  for (std::size_t i = 0; i < 8; ++i) {
    const std::size_t next = (i + 1) % 8;
    text += "\nf " + corner(i, 0) + corner(next, 0) + corner(next, 1) + corner(i, 1);
  }
  const test::TemporaryFolder folder;
  test::put_file(folder / "u.obj", text + "\n");
  return formats::read(folder / "u.obj").surface;
}

void check(const Surface& cage, double expected, const char* edit) {
  CAPTURE(edit);
  base::WorkerPool pool(1);
  const auto soundness = cages::soundness(cage, cage, pool);
  CHECK(soundness.open_edges == 0);
  CHECK(soundness.pinched_vertices == 0);
  CHECK(soundness.crossing.empty());
  CHECK(mesh::summarize(cage).volume == doctest::Approx(expected));
}

std::uint32_t vertex_at(const Surface& cage, const Point& at) {
  return static_cast<std::uint32_t>(std::ranges::find(cage.positions, at) - cage.positions.begin());
}

}  // namespace

TEST_CASE("edits_beside_concave_polygons_leave_one_surface") {
  const Surface u = letter_u();
  check(u, volume, "none");
  const auto within = vertex_at(u, {2, 1, 1}), above = vertex_at(u, {2, 3, 1});
  const mesh::Edge notch{std::min(within, above), std::max(within, above)};
  check(cages::split_edges(u, std::vector{notch}).surface, volume, "split");
  const std::vector<std::uint32_t> caps = {0, 1};
  check(cages::cut_polygons(u, caps).surface, volume, "cut");
  check(cages::subdivide(u).surface, volume, "subdivide");
  check(cages::extrude(u, std::vector<std::uint32_t>{1}, 0.5).surface, 1.5 * volume, "extrude");
}

TEST_CASE("mirroring_across_a_concave_polygon_splits_it") {
  const Surface u = letter_u();
  check(cages::mirrored(u, {{1, 0, 0}, 1.5}).surface, volume, "along its middle");
  check(cages::mirrored(u, {{0, -1, 0}, -2}).surface, 10, "across both arms, the foot kept");
  // The result is two bars with height 2.
  const Surface bars = cages::mirrored(u, {{0, 1, 0}, 2}).surface;
  check(bars, 4, "across both arms, their ends kept");
  CHECK(mesh::summarize(bars).parts == 2);
  // The plane contains the bottom of the notch.
  check(cages::mirrored(u, {{0, 1, 0}, 1}).surface, 8, "along the ground, the arms kept");
  check(cages::mirrored(u, {{0, -1, 0}, -1}).surface, 6, "along the ground, the foot kept");
}

TEST_CASE("fitted_cage_encloses_the_box_with_the_same_shape") {
  constexpr double margin = 0.01;
  const Surface model = letter_u(), cage = test::moved(test::torus(8, 6), 3, 10);
  const mesh::Bounds box = mesh::used_bounds(model);
  const cages::Fitted fitted = cages::fitted_to_box(cage, model, margin);
  const mesh::Bounds now = mesh::bounds(fitted.positions);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(now.high[k] - now.low[k] >=
          doctest::Approx(box.high[k] - box.low[k] + 2 * margin * box.diagonal()));
    CHECK(0.5 * (now.high[k] + now.low[k]) == doctest::Approx(box.center()[k]));
  }
  for (std::size_t v = 1; v < cage.positions.size(); ++v) {
    const Point offset = fitted.scale * (cage.positions[v] - cage.positions[0]);
    CHECK(mesh::norm(fitted.positions[v] - fitted.positions[0] - offset) < 1e-9);
  }
}
