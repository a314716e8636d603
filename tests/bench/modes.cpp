#include "bench/modes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "bench/following.h"
#include "bench/mode_comparison.h"
#include "bench/models.h"
#include "deform/shapes.h"
#include "mesh/shapes.h"

using namespace viete;
using namespace viete::bench;

namespace {

std::shared_ptr<const deform::Cage> tube_cage() {
  return std::make_shared<const deform::Cage>(deform::make_cage(test::tube(4, 6, 1.6, 4)));
}

ModeComparison compare(const mesh::Surface& model, const ModeSettings& settings = {.rounds = 1}) {
  const auto cage = tube_cage();
  const std::vector<NamedPose> poses = {{"rest", deform::rest_pose(*cage)},
                                        {"moderate", moderate_pose(*cage)}};
  base::Progress progress;
  return measure_modes(model, cage, poses, settings, progress);
}

}  // namespace

TEST_CASE("every_way_of_blending_is_measured_and_none_distorts_a_cage_at_rest") {
  const ModeSettings settings{.rounds = 1, .radius = deform::largest_radius};
  const auto compared = compare(test::sphere(2), settings);
  CHECK(compared.encloses);
  CHECK(compared.without_area == 0);
  CHECK(compared.modes.size() == deform::valid_schemes().size() + 1);  // and Way::arap
  for (deform::Scheme scheme : deform::valid_schemes()) {
    scheme.weighting.radius = deform::largest_radius;
    const auto found =
        std::ranges::find_if(compared.modes, [&](const Mode& m) { return m.scheme == scheme; });
    REQUIRE_MESSAGE(found != compared.modes.end(), deform::text(scheme));
    INFO(deform::text(scheme));
    CHECK(found->problem.empty());
    CHECK(found->deviations[0] < exactly);  // whatever does not move with its cage is of no use
    CHECK(std::isfinite(found->leak));
    REQUIRE(found->qualities.size() == 2);
    const ShapeQuality &rest = found->qualities[0], &posed = found->qualities[1];
    CHECK(rest.distortion.energy < 1e-9);
    CHECK(rest.volume == doctest::Approx(1));
    CHECK(rest.gap == doctest::Approx(compared.rest_gap));
    CHECK(std::isnan(rest.energy_ratio));  // of nothing over nothing
    // Rotations alone hardly distort.
    CHECK(posed.distortion.energy > (scheme.blend == deform::Blend::mls_rigid ? 1e-4 : 1e-3));
    CHECK(posed.energy_ratio > 0);
    CHECK(posed.bending_ratio > 0);
    if (deform::way_of(scheme) == deform::Way::mean_value) {
      CHECK(posed.energy_ratio == 1);
      CHECK(posed.bending_ratio == 1);
      CHECK(found->deviations[3] < exactly);
    }
    if (deform::way_of(scheme) == deform::Way::paper) {
      CHECK(found->deviations[2] < exactly);
      CHECK(found->deviations[3] > 1e-6);
    }
  }
}

TEST_CASE("an_open_model_has_no_volume_to_compare_and_all_else") {
  auto sphere = test::sphere(2);
  auto triangles = sphere.triangles;
  triangles.pop_back();
  triangles.push_back({0, 0, 1});
  const auto compared = compare(mesh::from_triangles(sphere.positions, triangles));
  CHECK_FALSE(compared.encloses);
  CHECK(compared.without_area == 1);
  for (const Mode& mode : compared.modes) {
    CHECK(std::isnan(mode.qualities[1].volume));
    CHECK(mode.qualities[1].distortion.energy > 1e-3);
  }
}

TEST_CASE("the_radius_is_that_of_all_modes_and_only_method_fast_has_fused_frames_of_exponentials") {
  const auto near = compare(test::sphere(2), {.rounds = 1, .radius = 0.1, .method = sym3::Method::diag});
  const auto all = compare(test::sphere(2));
  for (std::size_t m = 0; m < all.modes.size(); ++m) {
    const Mode& mode = near.modes[m];
    INFO(deform::text(mode.scheme));
    CHECK(mode.scheme.weighting.radius == 0.1);
    const bool changed = mode.qualities[1].distortion.energy != all.modes[m].qualities[1].distortion.energy;
    if (mode.scheme.weighting.partial()) CHECK(changed);
    if (mode.scheme.exponential()) CHECK_FALSE(mode.fused);
    if (mode.scheme.weighting.weights == deform::Weights::mean_value) CHECK(all.modes[m].fused);
  }
}
