// Compares both engines with independent code in quad precision.

#include "pose/all_maps.h"
#include "deform/bound.h"
#include "deform/independent.h"
#include "support/skip.h"

using namespace viete;
using namespace viete::test;

namespace {

// A rotation, a stretch and three waves. The map is not affine: each triangle moves differently.
struct Waves {
  Affine affine;
  std::array<Vec3, 3> direction, push;

  Waves(Random& random, double size)
      : affine(similarity(random.vector(1), random(0, 2.5), random(0.5, 2), random.vector(3 * size))) {
    for (double& m : affine.linear) m += random(-0.15, 0.15);
    for (auto& d : direction) d = random.vector(2 / size);
    for (auto& p : push) p = random.vector(0.05 * size);
  }

  Vec3 operator()(const Vec3& x) const {
    Vec3 p = affine(x);
    for (int i = 0; i < 3; ++i) p = p + std::sin(dot(direction[i], x) + i) * push[i];
    return p;
  }
};

// Returns points inside and outside the cage. No point is on the cage.
mesh::Surface points_about(const mesh::Surface& cage, Random& random) {
  const auto bounds = mesh::bounds(cage.positions);
  mesh::Surface points;
  for (int i = 0; i < 40; ++i)
    points.positions.push_back(bounds.center() + random.vector((i < 30 ? 0.25 : 0.6) * bounds.diagonal()));
  return points;
}

// Returns the largest allowed error, in diagonals of the posed cage: at least three times the measured error.
double staged_bound(const Deformer& deformer) {
  if (deformer.weighting.weights == Weights::mean_value) return 1e-13;
  return deformer.weighting.on_surface() ? 3e-14 : 1e-14;
}

void compare(Deformer deformer, const mesh::Surface& cage, const mesh::Surface& model, const Pose& pose) {
  CAPTURE(text(deformer));
  deformer.weighting.radius = deformer.has_maps() ? 0.3 : 0.5;
  Frames frames(model, cage, deformer);
  frames.fused.deform(pose, sym3::Method::fast);
  const auto staged = frames.staged.deform(pose);
  std::vector<AffineMap> patches(pose.positions.size());
  VertexPatches(*frames.staged.cage, frames.staged.cage->size)
      .compute(pose.positions, {0, 0, 0}, first(patches.size()), patches);
  const IndependentPose same{pose.positions, pose.turns.empty() ? Vec3{0, 0, 0} : pose.turns[0],
                             frames.fused.state().rows().moment_length, frames.staged.binding->weights,
                             patches};
  const auto exact = deform_independently(model.positions, cage, same, deformer);
  CHECK(exact.largest_step < 90 * degree);
  const double diagonal = mesh::bounds(pose.positions).diagonal();
  CHECK(largest_distance(staged, exact.positions) < staged_bound(deformer) * diagonal);
  // Maps fitted to few handles amplify the rounding of their weights (measured: 1.3e-6).
  const double fused_bound =
      deformer.weighting.partial() && has_moments(frames.fused.state().rows().form) ? 2e-6 : 1e-6;
  CHECK(largest_distance(frames.fused.positions(), exact.positions) < fused_bound * diagonal);
}

}  // namespace

TEST_CASE("frames_of_every_deformer_agree_with_an_evaluation_in_quad_precision" *
          doctest::test_suite(longer)) {
  Random random(2024);
  const mesh::Surface cages[] = {tube(6, 8, 0.6, 2), box({1, 2, 3}), tube(12, 16, 40, 90)};
  const mesh::Surface model = tube(7, 6, 0.3, 2.2);
  for (const auto& cage : cages) {
    const double size = mesh::bounds(cage.positions).diagonal();
    const auto points = points_about(cage, random);
    for (int n = 0; n < rounds(1, 4); ++n) {
      const Pose pose{mapped(cage.positions, Waves(random, size)), {}};
      for (const Deformer& deformer : valid_deformers()) {
        const bool on_surface = deformer.weighting.on_surface();
        if (!on_surface || &cage == cages) compare(deformer, cage, on_surface ? model : points, pose);
      }
    }
  }
}

TEST_CASE("frames_of_turns_beyond_180_degrees_agree_with_an_evaluation_in_quad_precision") {
  Random random(2025);
  const auto cage = tube(14, 8, 0.5, 3);
  const auto points = points_about(cage, random);
  const struct {
    double low, high;
    Vec3 turn;
  } twists[] = {{-220, 220, {0, 0, 0}}, {40, 300, {0, 0, 3}}, {40, 300, {0, 0, -3.5}}};
  for (const auto& t : twists) {
    const Twist twist{2, {0, 0, 0}, -1.5, 1.5, t.low * degree, t.high * degree};
    for (const Deformer& deformer : valid_deformers()) {
      if (deformer.weighting.partial() || deformer.weighting.on_surface()) continue;
      compare(deformer, cage, points, {mapped(cage.positions, twist), {t.turn}});
    }
  }
}
