// Frames of both engines against an evaluation of the formulas in quad precision that shares no code with
// them.
#include <doctest/doctest.h>

#include "deform/bind.h"
#include "deform/bound.h"
#include "deform/independent.h"
#include "deform/moment_rows.h"
#include "deform/moments.h"
#include "deform/ways.h"
#include "support/longer.h"

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
  double staged_bound;  // in diagonals of the posed cage; three times the worst of these poses or more
};
constexpr double end_of_reach = 3;

Weighting inverse_of(Elements elements, double reach = whole_cage, int exponent = 2) {
  return {.elements = elements, .weights = Weights::inverse, .reach = reach, .exponent = exponent};
}
Weighting cut_off_of(Elements elements, double radius, int exponent, bool normalise = false) {
  return {.elements = elements,
          .weights = Weights::cut_off,
          .radius = radius,
          .exponent = exponent,
          .normalise = normalise};
}

const Weighting of_faces = inverse_of(Elements::face), points = inverse_of(Elements::point),
                points_near = inverse_of(Elements::point, end_of_reach);
const Case cases[] = {
    {of_faces, Blend::srl, 1e-14},         {inverse_of(Elements::face, end_of_reach), Blend::srl, 1e-14},
    {of_faces, Blend::slrl, 1e-14},        {of_faces, Blend::sql, 1e-14},
    {of_faces, Blend::log3, 1e-13},        {of_faces, Blend::sse, 1e-13},
    {of_faces, Blend::log4, 1e-12},        {of_faces, Blend::linear, 1e-14},
    {face_integrals, Blend::srl, 5e-14},   {mean_values, Blend::linear, 1e-13},
    {points, Blend::mls_affine, 1e-14},    {points, Blend::mls_similarity, 1e-14},
    {points, Blend::mls_rigid, 1e-14},     {points_near, Blend::mls_affine, 1e-14},
    {points_near, Blend::mls_rigid, 1e-14}};

const Case other_elements[] = {
    {inverse_of(Elements::edge), Blend::srl, 1e-14},
    {inverse_of(Elements::vertex), Blend::srl, 1e-14},
    {inverse_of(Elements::vertex_face), Blend::srl, 1e-14},
    {inverse_of(Elements::patch), Blend::srl, 1e-14},
    {inverse_of(Elements::vertex_patch), Blend::srl, 1e-14},
    {inverse_of(Elements::edge, end_of_reach, 3), Blend::slrl, 1e-14},
    {inverse_of(Elements::vertex, end_of_reach), Blend::sql, 1e-14},
    {inverse_of(Elements::vertex_face, whole_cage, 4), Blend::linear, 1e-14},
    {inverse_of(Elements::patch, end_of_reach, 1), Blend::log3, 1e-14},
    {inverse_of(Elements::vertex_patch, whole_cage, 5), Blend::log4, 1e-14},
    {inverse_of(Elements::vertex), Blend::log3, 1e-14},
    {inverse_of(Elements::edge), Blend::sse, 1e-14},
    {inverse_of(Elements::face, end_of_reach, 8), Blend::srl, 1e-14},
    {inverse_of(Elements::point, end_of_reach, 3), Blend::linear, 1e-14},
    {{.elements = Elements::patch, .weights = Weights::integrated}, Blend::srl, 1e-14}};

const Case partial[] = {{cut_off_of(Elements::face, 0.3, 2), Blend::srl, 1e-14},
                        {cut_off_of(Elements::face, 0.2, 1), Blend::sse, 1e-14},
                        {cut_off_of(Elements::edge, 0.25, 3), Blend::slrl, 1e-14},
                        {cut_off_of(Elements::vertex, 0.4, 2), Blend::log3, 1e-14},
                        {cut_off_of(Elements::vertex_face, 0.3, 4), Blend::sql, 1e-14},
                        {cut_off_of(Elements::patch, 0.2, 8), Blend::linear, 1e-14},
                        {cut_off_of(Elements::vertex_patch, 0.3, 2), Blend::log4, 1e-14},
                        {cut_off_of(Elements::point, 0.4, 2), Blend::linear, 1e-14},
                        {cut_off_of(Elements::point, 0.5, 2), Blend::mls_affine, 1e-14},
                        {cut_off_of(Elements::point, 0.5, 2), Blend::mls_similarity, 1e-14},
                        {cut_off_of(Elements::vertex, 0.3, 2, true), Blend::srl, 1e-14}};

const Case along_the_surface[] = {
    {{.elements = Elements::face, .weights = Weights::harmonic}, Blend::srl, 3e-14},
    {{.elements = Elements::face, .weights = Weights::biharmonic}, Blend::slrl, 3e-14},
    {{.elements = Elements::vertex_patch, .weights = Weights::harmonic}, Blend::sse, 3e-14},
    {{.elements = Elements::edge, .weights = Weights::biharmonic}, Blend::srl, 3e-14},
    {{.elements = Elements::patch, .weights = Weights::harmonic}, Blend::log3, 3e-14},
    {{.elements = Elements::point, .weights = Weights::biharmonic}, Blend::mls_affine, 3e-14}};

// In diagonals of the posed cage.
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
             const Pose& pose, bool half_turns) {
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

void compare_on_small_cages(std::span<const Case> cases, unsigned seed) {
  Random random(seed);
  const mesh::Surface cages[] = {box({1, 2, 3}), tube(6, 8, 0.6, 2)};
  for (const auto& cage : cages) {
    const double size = mesh::bounds(cage.positions).diagonal();
    const auto points = points_about(cage, random);
    for (int n = 0; n < rounds(1, 2); ++n)
      compare(cases, cage, points, {mapped(cage.positions, Waves(random, size)), {}}, true);
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
      compare(cases, cage, points, {mapped(cage.positions, Waves(random, size)), {}}, true);
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
    for (const std::span<const Case> some :
         {std::span<const Case>(cases), std::span<const Case>(other_elements)})
      compare(some, cage, points, {mapped(cage.positions, twist), {t.turn}}, false);
  }
}

TEST_CASE("frames_of_all_elements_agree_with_an_evaluation_in_quad_precision" * doctest::test_suite(longer)) {
  compare_on_small_cages(other_elements, 2026);
}

TEST_CASE("frames_of_partial_weights_agree_with_an_evaluation_in_quad_precision" *
          doctest::test_suite(longer)) {
  compare_on_small_cages(partial, 2027);
}

TEST_CASE("frames_of_weights_along_the_surface_agree_with_an_evaluation_in_quad_precision") {
  Random random(2028);
  const auto cage = tube(6, 8, 0.6, 2), model = tube(7, 6, 0.3, 2.2);
  for (int n = 0; n < 2; ++n)
    compare(along_the_surface, cage, model, {mapped(cage.positions, Waves(random, 2)), {}}, true);
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
