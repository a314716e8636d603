#include "bench/modes.h"
#include "support/caged_shapes.h"
#include "support/shapes.h"

using namespace viete;
using namespace viete::bench;
using test::box;

namespace {

const pose::Cage cage = pose::make_cage(box({1, 1, 1}, {4, 5, 6}));
const std::vector<mesh::Point> model = test::moved(test::sphere(1), 0.5, 5).positions;

// Applies the affine map that takes four corners of the box to their posed positions.
std::vector<mesh::Point> with_the_box(const pose::Pose& pose) {
  const auto& p = pose.positions;
  std::vector<mesh::Point> moved;
  for (const mesh::Point& x : model) {
    const mesh::Point t = 0.5 * (x - cage.surface.positions[0]);
    moved.push_back(p[0] + t[0] * (p[1] - p[0]) + t[1] * (p[2] - p[0]) + t[2] * (p[4] - p[0]));
  }
  return moved;
}

std::vector<mesh::Point> by_the_mean(const pose::Pose& pose) {
  mesh::Point mean{0, 0, 0};
  for (std::size_t v = 0; v < 8; ++v) mean = mean + 0.125 * (pose.positions[v] - cage.surface.positions[v]);
  return test::mapped(model, [&](const mesh::Point& x) { return x + mean; });
}

ModeComparison compare(const mesh::Surface& model, const ModeSettings& settings = {.rounds = 1}) {
  const auto cage = std::make_shared<const pose::Cage>(pose::make_cage(test::tube(4, 6, 1.6, 4)));
  const std::vector<NamedPose> poses = {{"rest", pose::rest_pose(*cage)}, {"moderate", moderate_pose(*cage)}};
  base::Progress progress;
  return measure_modes(model, cage, poses, settings, progress);
}

}  // namespace

TEST_CASE("deviation_is_the_largest_distance_in_diagonals_of_the_posed_cage") {
  for (const auto& pose : whole_poses()) {
    CHECK(deviation(pose, cage, model, with_the_box) < 1e-14);
    const double by_mean = deviation(pose, cage, model, by_the_mean);
    CHECK((&pose == &whole_poses()[0] ? by_mean < 1e-14 : by_mean > 0.01));
  }
  const Deform stays = [](const pose::Pose&) { return model; };
  CHECK(deviation(whole_poses()[0], cage, model, stays) == doctest::Approx(std::sqrt(0.09 + 0.04 + 0.16)));
  const Deform one_off = [](const pose::Pose& pose) {
    auto moved = with_the_box(pose);
    moved[3][1] += 0.25;
    return moved;
  };
  CHECK(deviation(whole_poses()[0], cage, model, one_off) == doctest::Approx(0.25 / cage.diagonal));
  const Deform lost = [](const pose::Pose&) {
    return std::vector(model.size(), mesh::Point{std::nan(""), 0, 0});
  };
  CHECK(std::isnan(deviation(whole_poses()[0], cage, model, lost)));
}

TEST_CASE("leak_is_the_motion_of_vertices_far_from_the_moved_one") {
  // One of eight vertices moves by 0.1 diagonals. The whole model therefore moves by 0.1 / 8.
  CHECK(leak(cage, model, by_the_mean) == doctest::Approx(0.1 / 8));
  const Deform near_alone = [](const pose::Pose& pose) {
    auto moved = model;
    for (std::size_t v = 0; v < 8; ++v) {
      const auto& from = cage.surface.positions[v];
      for (std::size_t i = 0; i < model.size(); ++i)
        if (mesh::norm(model[i] - from) <= 0.25 * cage.diagonal)
          moved[i] = moved[i] + (pose.positions[v] - from);
    }
    return moved;
  };
  CHECK(leak(cage, model, near_alone) == 0);
  const std::vector<mesh::Point> none;
  CHECK(std::isnan(leak(cage, none, [&](const pose::Pose&) { return none; })));
}

TEST_CASE("the_gap_is_the_mean_distance_from_the_posed_nearest_points") {
  base::WorkerPool pool(1);
  const std::vector<mesh::Point> points = {{4.9, 5.1, 6.2}, {4, 4.3, 6}};  // 0.1 and 0.3 from a face
  const auto nearest = nearest_on_cage(cage, points, pool);
  const std::vector<double> shares = {0.75, 0.25};
  const auto& rest = cage.surface.positions;
  CHECK(gap(cage, nearest, shares, rest, points) ==
        doctest::Approx((0.75 * 0.1 + 0.25 * 0.3) / cage.diagonal));
  // The cage moves by 0.5 along x. This is away from the first point, and parallel to the face at the second.
  const auto away = test::mapped(rest, [](const mesh::Point& p) { return p + mesh::Point{0.5, 0, 0}; });
  CHECK(gap(cage, nearest, shares, away, points) ==
        doctest::Approx((0.75 * 0.6 + 0.25 * std::hypot(0.5, 0.3)) / cage.diagonal));
}

TEST_CASE("torn_is_the_largest_change_of_distance_of_near_unjoined_vertices") {
  // Two triangles at a distance of 0.005. The model's diagonal is nearly 1.
  const double side = std::sqrt(0.5);
  const std::vector<mesh::Point> rest = {{0, 0, 0},     {side, 0, 0},     {0, side, 0},
                                         {0, 0, 0.005}, {side, 0, 0.005}, {0, side, 0.005}};
  const auto pairs = near_pairs(mesh::from_triangles(rest, {{0, 1, 2}, {3, 4, 5}}));
  CHECK(pairs.size() == 6);  // each pair in both directions
  auto posed = test::mapped(rest, [](const mesh::Point& p) { return mesh::Point{p[1] + 3, -p[0], p[2]}; });
  CHECK(torn(pairs, rest, posed) < 1e-12);
  posed[5][2] += 0.1;
  CHECK(torn(pairs, rest, posed) == doctest::Approx(0.1).epsilon(1e-3));
  posed[5][2] = NAN;
  CHECK(std::isnan(torn(pairs, rest, posed)));
  CHECK(near_pairs(mesh::from_triangles(rest, {{0, 1, 2}})).empty());
  // A crack of width 0.0005. Only a long path of edges connects its sides.
  const std::vector<mesh::Point> cracked = {{0, 0, 0}, {side, 0, 0}, {0, side, 0}, {0.0005, 0, 0}};
  CHECK(near_pairs(mesh::from_triangles(cracked, {{0, 1, 2}, {1, 2, 3}})).size() == 2);
}

TEST_CASE("every_deformer_is_measured_and_none_distorts_a_cage_at_rest") {
  const ModeSettings settings{.rounds = 1, .radius = pose::number("radius").largest};
  const auto compared = compare(test::sphere(2), settings);
  CHECK(compared.encloses);
  CHECK(compared.without_area == 0);
  CHECK(compared.modes.size() == pose::valid_deformers().size() + 1);  // one more for Preset::arap
  for (pose::Deformer deformer : pose::valid_deformers()) {
    deformer.weighting.radius = pose::number("radius").largest;
    const auto found =
        std::ranges::find_if(compared.modes, [&](const Mode& m) { return m.deformer == deformer; });
    REQUIRE_MESSAGE(found != compared.modes.end(), pose::text(deformer));
    INFO(pose::text(deformer));
    CHECK(found->problem.empty());
    CHECK(found->deviations[0] < exactly);
    CHECK(std::isfinite(found->leak));
    REQUIRE(found->qualities.size() == 2);
    const ShapeQuality &rest = found->qualities[0], &posed = found->qualities[1];
    CHECK(rest.energy < 1e-9);
    CHECK(rest.volume == doctest::Approx(1));
    CHECK(rest.gap == doctest::Approx(compared.rest_gap));
    CHECK(std::isnan(rest.energy_ratio));  // 0 / 0
    // mls_rigid distorts less than the other deformers, because it only rotates.
    CHECK(posed.energy > (deformer.blend == pose::Blend::mls_rigid ? 1e-4 : 1e-3));
    CHECK(posed.energy_ratio > 0);
    CHECK(posed.bending_ratio > 0);
    if (pose::preset_of(deformer) == pose::Preset::mean_value) {
      CHECK(posed.energy_ratio == 1);
      CHECK(posed.bending_ratio == 1);
      CHECK(found->deviations[3] < exactly);
    }
    if (pose::preset_of(deformer) == pose::Preset::paper) {
      CHECK(found->deviations[2] < exactly);
      CHECK(found->deviations[3] > 1e-6);
    }
  }
}

TEST_CASE("an_open_model_has_all_measures_but_volume") {
  auto sphere = test::sphere(2);
  auto triangles = sphere.triangles;
  triangles.pop_back();
  triangles.push_back({0, 0, 1});
  const auto compared = compare(mesh::from_triangles(sphere.positions, triangles));
  CHECK_FALSE(compared.encloses);
  CHECK(compared.without_area == 1);
  for (const Mode& mode : compared.modes) {
    CHECK(std::isnan(mode.qualities[1].volume));
    CHECK(mode.qualities[1].energy > 1e-3);
  }
}

TEST_CASE("the_radius_is_that_of_all_modes_and_only_method_fast_has_fused_frames_of_exponentials") {
  const auto near = compare(test::sphere(2), {.rounds = 1, .radius = 0.1, .method = sym3::Method::diag});
  const auto all = compare(test::sphere(2));
  for (std::size_t m = 0; m < all.modes.size(); ++m) {
    const Mode& mode = near.modes[m];
    INFO(pose::text(mode.deformer));
    CHECK(mode.deformer.weighting.radius == 0.1);
    const bool changed = mode.qualities[1].energy != all.modes[m].qualities[1].energy;
    if (mode.deformer.weighting.partial()) CHECK(changed);
    if (mode.deformer.exponential()) CHECK_FALSE(mode.fused);
    if (mode.deformer.weighting.weights == pose::Weights::mean_value) CHECK(all.modes[m].fused);
  }
}
