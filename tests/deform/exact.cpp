#include "deform/exact.h"

#include <fstream>

#include "deform/bound.h"
#include "support/skip.h"

using namespace viete;
using namespace viete::test;
using sym3::Method;

namespace {

constexpr Method all_methods[] = {Method::diag, Method::sd, Method::improved_sd, Method::fast};

mesh::Surface cloud(std::size_t count) {
  Random random(7);
  mesh::Surface surface;
  for (std::size_t i = 0; i < count; ++i) surface.positions.push_back(random.vector(0.95));
  return surface;
}

// Bends and stretches a point. The eigenvalues of the stretch are well separated, so every method is exact.
Vec3 bent_and_stretched(const Vec3& p) {
  return {0.6 * p[0] + 0.1 * p[1] * p[1], 1.4 * p[1], 2.2 * p[2] - 0.2 * p[0]};
}

ExactModel deform_exactly(const Bound& b, const Pose& pose, Method method = Method::fast, int threads = 2) {
  base::WorkerPool pool(threads);
  return deform::deform_exactly(b.model, b.cage, {b.binding->weighting, Blend::srl}, pose, method, pool);
}

double diagonals_from_staged(Bound& b, const Pose& pose, Method method) {
  const auto exact = deform_exactly(b, pose, method);
  return largest_distance(exact.positions, b.deform(pose, method)) / b.cage->diagonal;
}

// Returns a value from /proc/self/status, in bytes.
std::optional<double> memory(const std::string& key) {
  std::ifstream in("/proc/self/status");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(key + ":")) return 1024 * std::stod(line.substr(key.size() + 1));
  return std::nullopt;
}

}  // namespace

TEST_CASE("block_by_block_equals_the_staged_frame_for_every_method_and_weighting") {
  for (const Weighting weighting : {faces, test::cut_off(0.2), mean_values}) {
    Bound b(cloud(700), tube(9, 12, 1.4, 4), weighting);
    const Pose pose = b.pose(bent_and_stretched);
    for (const Method method : all_methods) {
      CAPTURE(sym3::name(method));
      CHECK(diagonals_from_staged(b, pose, method) < 1e-12);
    }
    for (const Pose& turned : {pose, b.pose(bent_and_stretched, {{0, 0, 2 * std::numbers::pi}})}) {
      CHECK(diagonals_from_staged(b, turned, Method::fast) < 1e-12);
      CHECK(largest_distance(deform_exactly(b, turned).report.turns, b.report().turns) == 0);
    }
    const auto rest = deform_exactly(b, rest_pose(*b.cage));
    CHECK(largest_distance(rest.positions, b.model.positions) < 4e-15 * b.cage->diagonal);
  }
}

// A block has 4096 vertices for a cage of 12 elements, and 16 vertices for 7200 elements. There are 8 lanes.
TEST_CASE("vertex_counts_at_block_and_lane_limits_are_exact") {
  for (const std::size_t n : {1, 7, 8, 9, 4095, 4096, 4097, 8200}) {
    CAPTURE(n);
    Bound b(cloud(n), box());
    CHECK(diagonals_from_staged(b, b.pose(bent_and_stretched), Method::fast) < 1e-12);
  }
  for (const std::size_t n : {15, 16, 17, 53}) {
    CAPTURE(n);
    Bound b(cloud(n), tube(60, 60, 1.4, 4), test::cut_off(0.3));
    CHECK(diagonals_from_staged(b, b.pose(bent_and_stretched), Method::fast) < 1e-12);
  }
}

TEST_CASE("block_by_block_gives_the_same_bits_for_any_number_of_threads") {
  for (const auto& c : {faces, mean_values}) {
    const Bound b(cloud(9000), box(), c);
    const Pose pose = b.pose(bent_and_stretched);
    const auto one = deform_exactly(b, pose, Method::diag, 1),
               four = deform_exactly(b, pose, Method::diag, 4);
    CHECK(one.positions == four.positions);
    CHECK(one.exp_error == four.exp_error);
  }
}

TEST_CASE("each_pose_has_the_same_bits_alone_and_in_sequence") {
  using Kept = ExactDeformer::Weights;
  for (const bool stitched : {false, true})
    for (const Weighting weighting : {faces, mean_values}) {
      if (stitched && weighting == mean_values) continue;  // these weights cannot be stitched
      const Bound b(stitched ? tube(8, 14, 0.9, 3) : cloud(700), tube(9, 12, 1.4, 4), weighting);
      Deformer deformer{weighting, Blend::srl};
      if (stitched) deformer.iterations = 2;
      const auto mask = std::make_shared<const std::vector<float>>(b.model.positions.size(), 0.75F);
      for (const Mask& painted : {Mask(), Mask(mask)}) {
        base::WorkerPool pool(2);
        ExactDeformer kept(b.model, b.cage, deformer, Method::fast, pool, Kept::kept, painted);
        ExactDeformer dropped(b.model, b.cage, deformer, Method::fast, pool, Kept::dropped, painted);
        for (const double by : {0.3, 1.0, 0.3}) {
          const Pose pose = b.pose([&](const Vec3& p) { return p + by * (bent_and_stretched(p) - p); });
          const auto alone =
              deform::deform_exactly(b.model, b.cage, deformer, pose, Method::fast, pool, nullptr, painted);
          CHECK(kept.deform(pose).positions == alone.positions);
          CHECK(dropped.deform(pose).positions == alone.positions);
        }
      }
    }
}

TEST_CASE("errors_of_methods_at_close_eigenvalues_are_reported") {
  const Bound b(cloud(200), box());
  double lost = 0;
  for (const double gap : {1e-4, 3e-5, 1e-5, 3e-6, 2e-6}) {
    const Pose pose = b.pose(Affine{{2, 0, 0, 0, 2 - gap, 0, 0, 0, 2 + gap}, {}});
    lost = std::max(lost, deform_exactly(b, pose, Method::sd).exp_error);
    CHECK(deform_exactly(b, pose, Method::diag).exp_error < 1e-13);
    CHECK(deform_exactly(b, pose, Method::fast).exp_error == 0);
  }
  CHECK(lost > 1e-9);
  CHECK(lost < 1);
  CHECK(deform_exactly(b, b.pose(bent_and_stretched), Method::sd).exp_error < 1e-12);
}

TEST_CASE("large_models_in_surface_weights_are_deformed_as_by_the_staged_engine" *
          doctest::test_suite(longer)) {
  Bound b(tube(300, 300, 0.9, 3), box({1.5, 2, 2}), biharmonics);
  REQUIRE(b.model.positions.size() > 2 * 40'000);
  CHECK(diagonals_from_staged(b, b.pose(bent_and_stretched), Method::fast) < 1e-12);
}

TEST_CASE("exact_deformers_reject_empty_models_and_other_poses_and_can_be_cancelled") {
  const Bound b(cloud(9000), box());
  base::WorkerPool pool(2);
  const Pose pose = rest_pose(*b.cage);
  CHECK_THROWS_AS(deform::deform_exactly({}, b.cage, {faces}, pose, Method::fast, pool), base::Error);
  CHECK_THROWS_AS(deform_exactly(b, Pose{{{0, 0, 0}}, {}}), base::Error);
  base::Progress progress;
  deform::deform_exactly(b.model, b.cage, {faces}, pose, Method::fast, pool, &progress);
  CHECK(progress.done() == 1);
  progress.cancel();
  CHECK_THROWS_AS(deform::deform_exactly(b.model, b.cage, {faces}, pose, Method::fast, pool, &progress),
                  base::Cancelled);
}

TEST_CASE("weights_of_all_vertices_are_never_in_memory_at_once" * doctest::test_suite(if_present)) {
  const auto model = cloud(16'000);
  const auto cage = std::make_shared<const Cage>(make_cage(tube(50, 60, 1.4, 4)));
  const double matrix = 8.0 * static_cast<double>(model.positions.size() * cage->element_count());
  std::ofstream("/proc/self/clear_refs") << 5;  // resets the peak of the memory use
  const auto before = memory("VmHWM");
  const auto now = memory("VmRSS");
  if (!before || !now || *before > 1.1 * *now) {
    skip("this system does not tell the peak of memory");
    return;
  }
  base::WorkerPool pool(2);
  deform::deform_exactly(model, cage, {test::cut_off(0.3)}, rest_pose(*cage), Method::fast, pool);
  CHECK(*memory("VmHWM") - *before < 0.5 * matrix);
}
