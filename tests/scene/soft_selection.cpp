#include "scene/hand/soft_selection.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/surface.h"

using namespace viete;
using namespace viete::scene;

namespace {

// A strip of quads along x, two units apart in y, folded back over itself halfway: its ends lie close.
deform::Cage hairpin() {
  std::vector<mesh::Point> points;
  std::vector<mesh::Triangle> triangles;
  for (int i = 0; i < 8; ++i) {
    const double x = i < 4 ? i : 7 - i, z = i < 4 ? 0 : 0.5;
    points.push_back({x, 0, z});
    points.push_back({x, 2, z});
  }
  for (std::uint32_t i = 0; i + 1 < 8; ++i) {
    triangles.push_back({2 * i, 2 * i + 2, 2 * i + 1});
    triangles.push_back({2 * i + 2, 2 * i + 3, 2 * i + 1});
  }
  return deform::make_cage(mesh::from_triangles(points, triangles));
}

double share_of(const std::vector<Softened>& all, std::uint32_t v) {
  const auto found = std::ranges::find(all, v, &Softened::vertex);
  return found == all.end() ? 0 : found->share;
}

}  // namespace

TEST_CASE("shares_are_1_at_the_selection_0_at_the_radius_and_fall_between") {
  for (const SoftCurve curve : {SoftCurve::smooth, SoftCurve::sharp, SoftCurve::linear}) {
    CHECK(soft_share(curve, 0) == 1);
    CHECK(soft_share(curve, 1) == 0);
    CHECK(soft_share(curve, std::nan("")) == 0);
    for (double d = 0; d < 1; d += 0.125) CHECK(soft_share(curve, d) > soft_share(curve, d + 0.125));
  }
  CHECK(soft_share(SoftCurve::constant, 0.999) == 1);
  CHECK(soft_share(SoftCurve::constant, 1) == 0);
  CHECK(soft_share(SoftCurve::smooth, 0.5) == 0.5);
  CHECK(soft_share(SoftCurve::sharp, 0.5) == 0.25);
}

TEST_CASE("over_edges_the_other_end_of_a_hairpin_is_far_and_through_space_it_is_near") {
  const deform::Cage cage = hairpin();
  const std::array<std::uint32_t, 2> end{0, 1};
  SoftSelection soft{.on = true, .curve = SoftCurve::linear};
  const auto over = softened(cage, cage.surface.positions, end, soft, 2);
  CHECK(share_of(over, 0) == 1);
  CHECK(share_of(over, 2) == doctest::Approx(0.5));
  CHECK(share_of(over, 4) == 0);
  CHECK(share_of(over, 14) == 0);
  soft.distance = SoftDistance::space;
  const auto through = softened(cage, cage.surface.positions, end, soft, 2);
  CHECK(share_of(through, 14) == doctest::Approx(0.75));
  CHECK(std::ranges::is_sorted(through, {}, &Softened::vertex));
}

TEST_CASE("each_goes_with_the_nearest_of_the_selected_ones") {
  const deform::Cage cage = hairpin();
  const std::array<std::uint32_t, 2> both{0, 14};  // the two ends
  for (const SoftDistance distance : {SoftDistance::edges, SoftDistance::space}) {
    const auto all = softened(cage, cage.surface.positions, both, {.on = true, .distance = distance}, 2.5);
    for (const auto& [vertex, share, nearest] : all) {
      if (vertex == 2 || vertex == 0) CHECK(nearest == 0);
      if (vertex == 12 || vertex == 14) CHECK(nearest == 1);
    }
  }
  CHECK(softened(cage, cage.surface.positions, {}, {.on = true}, 2.5).empty());
}
