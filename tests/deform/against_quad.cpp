// Compares frames of both engines with an evaluation of the formulas in quad precision that shares no code
// with them.
#include <doctest/doctest.h>

#include "deform/bind.h"
#include "deform/binding.h"
#include "deform/bound.h"
#include "deform/independent.h"
#include "deform/maps.h"
#include "deform/moments.h"
#include "deform/scheme.h"
#include "support/longer.h"

using namespace viete;
using namespace viete::test;

namespace {

// A rotation and a stretch plus three waves: not affine, and no two triangles move alike.
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

// Points inside and outside the cage, but not on it.
mesh::Surface points_about(const mesh::Surface& cage, Random& random) {
  const auto bounds = mesh::bounds(cage.positions);
  mesh::Surface points;
  for (int i = 0; i < 40; ++i)
    points.positions.push_back(bounds.center() + random.vector((i < 30 ? 0.25 : 0.6) * bounds.diagonal()));
  return points;
}

struct Errors {
  double staged = 0, fused = 0;
};

struct Case {
  Weighting weighting;
  Blend blend;
  double staged_bound;  // in diagonals of the posed cage; at least three times the worst of these poses
};

Weighting cut_off_of(Elements elements, double radius) {
  return {.elements = elements, .weights = Weights::cut_off, .radius = radius};
}

constexpr Weighting points{Elements::point, Weights::inverse};
const Case cases[] = {{faces, Blend::srl, 1e-14},
                      {faces, Blend::linear, 1e-14},
                      {mean_values, Blend::linear, 1e-13},
                      {points, Blend::mls_affine, 1e-14},
                      {points, Blend::mls_similarity, 1e-14},
                      {points, Blend::mls_rigid, 1e-14}};

const Case partial[] = {{cut_off_of(Elements::face, 0.3), Blend::srl, 1e-14},
                        {cut_off_of(Elements::face, 0.2), Blend::linear, 1e-14},
                        {cut_off_of(Elements::point, 0.5), Blend::mls_affine, 1e-14},
                        {cut_off_of(Elements::point, 0.5), Blend::mls_similarity, 1e-14}};

const Case along_the_surface[] = {{harmonics, Blend::srl, 3e-14},
                                  {biharmonics, Blend::linear, 3e-14},
                                  {{Elements::point, Weights::biharmonic}, Blend::mls_affine, 3e-14}};

// Errors in diagonals of the posed cage.
Errors errors(const Case& c, const mesh::Surface& cage, const mesh::Surface& points, const Pose& pose) {
  Bound staged(points, cage, c.weighting, 2, c.blend);
  const auto tiled = std::make_shared<const Binding>(
      bind(points, *staged.cage, c.weighting, EngineKind::fused, nullptr, staged.pool));
  Deformer fused(staged.cage, tiled, {c.weighting, c.blend}, staged.pool);
  fused.deform(pose, sym3::Method::fast);
  const IndependentPose same{pose.positions, pose.turns.empty() ? Vec3{0, 0, 0} : pose.turns[0],
                             moment_length(*staged.cage), staged.binding->weights};
  const auto exact = deform_independently(points.positions, cage, same, {c.weighting, c.blend});
  CHECK(exact.largest_step < 90 * degree);
  const double diagonal = mesh::bounds(pose.positions).diagonal();
  return {largest_distance(staged.deform(pose), exact.positions) / diagonal,
          largest_distance(fused.positions(), exact.positions) / diagonal};
}

void compare(std::span<const Case> cases, const mesh::Surface& cage, const mesh::Surface& points,
             const Pose& pose) {
  for (const auto& c : cases) {
    const Errors e = errors(c, cage, points, pose);
    CAPTURE(text({c.weighting, c.blend}));
    CHECK(e.staged < c.staged_bound);
    CHECK(e.fused < 1e-6);
  }
}

}  // namespace

TEST_CASE("frames_of_random_poses_agree_with_an_evaluation_in_quad_precision" * doctest::test_suite(longer)) {
  Random random(2024);
  const mesh::Surface cages[] = {box({1, 2, 3}), tube(6, 8, 0.6, 2), tube(12, 16, 40, 90)};
  for (const auto& cage : cages) {
    const double size = mesh::bounds(cage.positions).diagonal();
    const auto points = points_about(cage, random);
    for (int n = 0; n < rounds(1, 4); ++n)
      compare(cases, cage, points, {mapped(cage.positions, Waves(random, size)), {}});
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
    compare(cases, cage, points, {mapped(cage.positions, twist), {t.turn}});
  }
}

TEST_CASE("frames_of_partial_weights_agree_with_an_evaluation_in_quad_precision" *
          doctest::test_suite(longer)) {
  Random random(2027);
  const mesh::Surface cages[] = {box({1, 2, 3}), tube(6, 8, 0.6, 2)};
  for (const auto& cage : cages) {
    const double size = mesh::bounds(cage.positions).diagonal();
    const auto points = points_about(cage, random);
    for (int n = 0; n < rounds(1, 2); ++n)
      compare(partial, cage, points, {mapped(cage.positions, Waves(random, size)), {}});
  }
}

TEST_CASE("frames_of_weights_along_the_surface_agree_with_an_evaluation_in_quad_precision") {
  Random random(2028);
  const auto cage = tube(6, 8, 0.6, 2), model = tube(7, 6, 0.3, 2.2);
  for (int n = 0; n < 2; ++n)
    compare(along_the_surface, cage, model, {mapped(cage.positions, Waves(random, 2)), {}});
}

TEST_CASE("frames_of_every_scheme_agree_with_an_evaluation_in_quad_precision") {
  Random random(2029);
  const auto cage = tube(5, 6, 0.6, 2), model = tube(5, 5, 0.3, 2.2);
  const Pose pose{mapped(cage.positions, Waves(random, 2)), {}};
  for (Scheme scheme : valid_schemes()) {
    CAPTURE(text(scheme));
    scheme.weighting.radius = 0.3;
    const Errors e = errors({scheme.weighting, scheme.blend, 0}, cage, model, pose);
    CHECK(e.staged < 1e-13);
    CHECK(e.fused < 1e-6);
  }
}
