// Frames of both engines against an evaluation of the formulas in quad precision that shares no code with
// them.
#include <doctest/doctest.h>

#include <numeric>

#include "deform/bound.h"
#include "deform/independent.h"
#include "deform/moments.h"

using namespace viete;
using namespace viete::test;

namespace {

// A rotation and a stretch, and on top of them three waves: no affine map, and no two triangles move alike.
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

// Some inside, some outside, none on the cage.
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
  IndependentScheme scheme;
  double staged_bound;  // in diagonals of the posed cage; three times the worst of these poses or more
};
constexpr double end_of_reach = 3;
const Weighting points{Elements::point}, points_near{Elements::point, Weights::inverse, end_of_reach};
const Case cases[] = {{faces, Blend::srl, IndependentScheme::faces_srl, 1e-14},
                      {faces_reaching(end_of_reach), Blend::srl, IndependentScheme::faces_srl, 1e-14},
                      {faces, Blend::slrl, IndependentScheme::faces_slrl, 1e-14},
                      {faces, Blend::sql, IndependentScheme::faces_sql, 1e-14},
                      {faces, Blend::log3, IndependentScheme::faces_log3, 1e-13},
                      {faces, Blend::sse, IndependentScheme::faces_sse, 1e-13},
                      {faces, Blend::log4, IndependentScheme::faces_log4, 1e-12},
                      {faces, Blend::linear, IndependentScheme::faces_linear, 1e-14},
                      {face_integrals, Blend::srl, IndependentScheme::face_integrals_srl, 5e-14},
                      {mean_values, Blend::linear, IndependentScheme::points_mean_value, 1e-13},
                      {points, Blend::mls_affine, IndependentScheme::points_affine, 1e-14},
                      {points, Blend::mls_similarity, IndependentScheme::points_similar, 1e-14},
                      {points, Blend::mls_rigid, IndependentScheme::points_rigid, 1e-14},
                      {points_near, Blend::mls_affine, IndependentScheme::points_affine, 1e-14},
                      {points_near, Blend::mls_rigid, IndependentScheme::points_rigid, 1e-14}};

IndependentClouds clouds(const Cage& cage, const Pose& pose) {
  const auto elements = element_maps(cage, Elements::vertex_patch);
  std::vector<std::uint32_t> all(elements->count());
  std::iota(all.begin(), all.end(), 0u);
  std::vector<AffineMap> maps(elements->count());
  elements->compute(pose.positions, {0, 0, 0}, all, maps);
  IndependentClouds clouds{moment_length(cage), {}};
  for (const AffineMap& m : maps) clouds.maps.push_back(m.linear);
  return clouds;
}

// In diagonals of the posed cage.
Errors errors(const Case& c, const mesh::Surface& cage, const mesh::Surface& points, const Pose& pose) {
  Bound staged(points, cage, c.weighting, 2, c.blend);
  const auto tiled = std::make_shared<const Binding>(
      bind(points, *staged.cage, c.weighting, EngineKind::fused, nullptr, staged.pool));
  Deformer fused(staged.cage, tiled, {c.weighting, c.blend}, staged.pool);
  fused.deform(pose, sym3::Method::fast);
  const IndependentPose same{pose.positions, pose.turns.empty() ? Vec3{0, 0, 0} : pose.turns[0],
                             clouds(*staged.cage, pose)};
  const auto exact = deform_independently(points.positions, cage, same, c.scheme, c.weighting.used_reach());
  CHECK(exact.largest_step < 90 * degree);
  const double diagonal = mesh::bounds(pose.positions).diagonal();
  return {largest_distance(staged.deform(pose), exact.positions) / diagonal,
          largest_distance(fused.positions(), exact.positions) / diagonal};
}

void compare(const mesh::Surface& cage, const mesh::Surface& points, const Pose& pose, bool half_turns) {
  for (const auto& c : cases) {
    if ((c.blend == Blend::log3 || c.blend == Blend::log4) && !half_turns)
      continue;  // principal logs alone are compared
    // Logs of motions are not exact within 60 degrees of a whole turn.
    if (c.blend == Blend::sse && !pose.turns.empty() && norm(pose.turns[0]) > 0) continue;
    const Errors e = errors(c, cage, points, pose);
    CAPTURE(text({c.weighting, c.blend}));
    CHECK(e.staged < c.staged_bound);
    CHECK(e.fused < 1e-6);
  }
}

}  // namespace

TEST_CASE("frames_of_random_poses_agree_with_an_evaluation_in_quad_precision") {
  Random random(2024);
  const mesh::Surface cages[] = {box({1, 2, 3}), tube(6, 8, 0.6, 2), tube(12, 16, 40, 90)};
  for (const auto& cage : cages) {
    const double size = mesh::bounds(cage.positions).diagonal();
    const auto points = points_about(cage, random);
    for (int n = 0; n < 4; ++n)
      compare(cage, points, {mapped(cage.positions, Waves(random, size)), {}}, true);
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
    compare(cage, points, {mapped(cage.positions, twist), {t.turn}}, false);
  }
}
