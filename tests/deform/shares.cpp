// Vertices with a share of their motion, from partial weights and from a mask.
#include <doctest/doctest.h>

#include "deform/binding.h"
#include "deform/bound.h"
#include "deform/exact.h"
#include "deform/scheme.h"
#include "deform/vertex_sample.h"
#include "sym3/rotation.h"

using namespace viete;
using namespace viete::test;

namespace {

constexpr auto shared_fast = sym3::Method::fast;

mesh::Surface shared_model() {
  return tube(40, 24, 0.3, 3);
}

// Shares from 0 at one end to 1 at the other.
Mask ramp(const mesh::Surface& model) {
  std::vector<float> mask;
  for (const auto& p : model.positions)
    mask.push_back(static_cast<float>(std::clamp(p[2] / 2 + 0.5, 0.0, 1.0)));
  return std::make_shared<const std::vector<float>>(std::move(mask));
}

Mask everywhere(const mesh::Surface& model, float share) {
  return std::make_shared<const std::vector<float>>(model.positions.size(), share);
}

struct SharedFrames {
  explicit SharedFrames(const Scheme& scheme_, const mesh::Surface& cage = tube(9, 7, 0.4, 2.2))
      : scheme(scheme_),
        staged(shared_model(), cage, scheme.weighting, 2, scheme.blend),
        fused(staged.cage,
              std::make_shared<const Binding>(bind(staged.model, *staged.cage, scheme.weighting,
                                                   EngineKind::fused, nullptr, staged.pool)),
              scheme, staged.pool) {}

  void set_mask(const Mask& mask_) {
    mask = mask_;
    staged.deformer.set_mask(mask);
    fused.set_mask(mask);
  }

  // The result of the two engines and the exact model, which must agree.
  std::vector<mesh::Point> deform(const Pose& pose) {
    const auto positions = staged.deform(pose);
    fused.deform(pose, shared_fast);
    const double far = std::max(staged.cage->diagonal, mesh::bounds(pose.positions).diagonal());
    CHECK(largest_distance(fused.positions(), positions) < 2e-5 * far);
    const auto exact =
        deform_exactly(staged.model, staged.cage, scheme, pose, shared_fast, staged.pool, nullptr, mask);
    CHECK(largest_distance(exact.positions, positions) < 1e-12 * far);
    return positions;
  }

  Scheme scheme;
  Mask mask;
  Bound staged;
  Deformer fused;
};

const Twist shared_twist{2, {0.1, 0, 0}, -1.1, 1.1, -60 * degree, 70 * degree};

}  // namespace

TEST_CASE("a_mask_of_ones_changes_nothing_and_one_of_zeros_leaves_the_model_at_rest") {
  for (const Scheme& scheme : whole_schemes()) {
    CAPTURE(text(scheme));
    SharedFrames f(scheme);
    const Pose pose = f.staged.pose(shared_twist);
    const auto whole = f.deform(pose);
    f.set_mask(everywhere(f.staged.model, 1));
    CHECK(largest_distance(f.deform(pose), whole) < 1e-12 * f.staged.cage->diagonal);
    f.set_mask(everywhere(f.staged.model, 0));
    CHECK(largest_distance(f.deform(pose), f.staged.model.positions) < 1e-14 * f.staged.cage->diagonal);
    f.set_mask(nullptr);
    CHECK(largest_distance(f.deform(pose), whole) == 0);
  }
}

TEST_CASE("shares_scale_translations_and_linearly_blended_rotations") {
  const Vec3 axis = (1 / norm(Vec3{1, -2, 3})) * Vec3{1, -2, 3}, way{3, -1, 2};
  const auto moved = [&](const Vec3& x) { return x + way; };
  const auto turned = similarity(axis, 80 * degree);
  for (const Scheme& scheme : whole_schemes()) {
    CAPTURE(text(scheme));
    SharedFrames f(scheme);
    f.set_mask(ramp(f.staged.model));
    const auto& rest = f.staged.model.positions;
    const auto by_way = f.deform(f.staged.pose(moved)), by_turn = f.deform(f.staged.pose(turned));
    for (std::size_t i = 0; i < rest.size(); i += 7) {
      const double s = static_cast<double>((*f.mask)[i]);
      CHECK(norm(by_way[i] - (rest[i] + s * way)) < 1e-12);
      const Vec3 straight = (1 - s) * rest[i] + s * turned(rest[i]);
      if (scheme.blend == Blend::linear) CHECK(norm(by_turn[i] - straight) < 1e-12);
    }
  }
}

TEST_CASE("shares_scale_rotation_stretch_and_translation_about_the_centre_of_the_handles") {
  const auto turned = similarity({1, -2, 3}, 80 * degree, 1.5, {1, 0.5, -2});
  SharedFrames f({faces});
  f.set_mask(ramp(f.staged.model));
  const auto posed = f.deform(f.staged.pose(turned));
  for (std::size_t i = 0; i < posed.size(); i += 5) {
    const double s = static_cast<double>((*f.mask)[i]);
    const Vec3& x = f.staged.model.positions[i];
    const Vec3 o = f.staged.binding->offsets[i], center = x - o;
    const auto part = similarity({1, -2, 3}, s * 80 * degree, std::pow(1.5, s));
    CHECK(norm(posed[i] - (s * turned(center) + (1 - s) * x + s * part(o))) < 1e-12);
  }
}

TEST_CASE("shares_do_not_depend_on_the_position_of_the_scene") {
  const Vec3 way{1000, -2000, 500};
  for (const Weighting& weighting : {test::cut_off(0.1), faces}) {
    SharedFrames here({weighting});
    Bound there(shared_model(), tube(9, 7, 0.4, 2.2), weighting);
    for (auto& p : there.model.positions) p = p + way;
    auto cage = tube(9, 7, 0.4, 2.2);
    for (auto& p : cage.positions) p = p + way;
    Bound moved(there.model, cage, weighting);
    here.set_mask(ramp(here.staged.model));
    moved.deformer.set_mask(here.mask);
    const auto a = here.deform(here.staged.pose(shared_twist));
    const auto b = moved.deform(moved.pose([&](const Vec3& x) { return shared_twist(x - way) + way; }));
    CHECK(largest_distance(mapped(a, [&](const Vec3& x) { return x + way; }), b) < 1e-11);
  }
}

TEST_CASE("vertices_follow_within_the_cut_off_radius_and_keep_every_bit_beyond") {
  for (Scheme scheme : valid_schemes()) {
    if (!scheme.weighting.partial()) continue;
    CAPTURE(text(scheme));
    scheme.weighting.radius = 0.08;
    SharedFrames f(scheme);
    const auto posed = f.deform(f.staged.pose(similarity({0, 0, 1}, 30 * degree, 1.1, {0.2, 0, 0})));
    const auto& shares = f.staged.binding->shares;
    std::size_t staying = 0, partly = 0;
    for (std::size_t i = 0; i < posed.size(); ++i) {
      const double way = norm(posed[i] - f.staged.model.positions[i]);
      if (shares[i] == 0) CHECK(way < 1e-15);
      if (shares[i] > 0.5) CHECK(way > 0.01);
      staying += shares[i] == 0, partly += shares[i] > 0 && shares[i] < 1;
    }
    CHECK(staying > 20);
    CHECK(partly > 20);
    // A radius that reaches everything gives no shares, and a mask multiplies existing ones.
    f.set_mask(everywhere(f.staged.model, 0.5f));
    f.deform(f.staged.pose(shared_twist));
    scheme.weighting.radius = largest_radius;
    CHECK(SharedFrames(scheme).staged.binding->shares.empty());
  }
}

TEST_CASE("the_share_of_cut_off_weights_has_no_jump") {
  Bound near(shared_model(), tube(9, 7, 0.4, 2.2), test::cut_off(0.1));
  const auto& model = near.model;
  const auto posed = near.deform(near.pose(similarity({0, 0, 1}, 30 * degree, 1, {0.2, 0, 0})));
  CHECK(largest_edge_stretch(model, posed) < 5);
}

TEST_CASE("a_masked_drag_equals_a_full_frame_even_when_the_mask_changes") {
  for (const Weighting& weighting : {faces, test::cut_off(0.15)}) {
    SharedFrames f({weighting}, tube(20, 12, 0.6, 3));
    Pose pose = f.staged.pose(shared_twist);
    f.set_mask(ramp(f.staged.model));
    f.fused.deform(pose, shared_fast);
    const std::uint32_t vertex[] = {100};
    f.fused.begin_drag(vertex);
    for (int step = 0; step < 6; ++step) {
      pose.positions[100][0] += 0.03;
      if (step == 3) f.set_mask(everywhere(f.staged.model, 0.4f));
      f.fused.deform(pose, shared_fast);
      CHECK(largest_distance(f.fused.positions(), f.staged.deform(pose)) < 2e-5 * f.staged.cage->diagonal);
    }
    CHECK(f.fused.sampled_error() < 2e-5);
  }
}

TEST_CASE("stitched_frames_respect_masks") {
  for (const int iterations : {1, 3}) {
    Scheme scheme{faces};
    scheme.iterations = iterations;
    Bound b(shared_model(), tube(9, 7, 0.6, 3.4));
    const auto tiles = std::make_shared<const Binding>(
        bind(b.model, *b.cage, scheme.weighting, EngineKind::fused, nullptr, b.pool));
    const auto stitching = std::make_shared<const Stitching>(stitch(b.model, *b.cage, b.pool));
    Deformer stitched(b.cage, tiles, scheme, b.pool, stitching);
    const Pose pose = b.pose(shared_twist);
    for (const Mask& mask : {ramp(b.model), everywhere(b.model, 0)}) {
      stitched.set_mask(mask);
      stitched.deform(pose, shared_fast);
      REQUIRE(stitched.ran() == EngineKind::stitched);
      const auto exact = deform_exactly(b.model, b.cage, scheme, pose, shared_fast, b.pool, nullptr, mask);
      CHECK(largest_distance(stitched.positions(), exact.positions) < 1e-5 * b.cage->diagonal);
    }
    CHECK(largest_distance(stitched.positions(), b.model.positions) < 1e-5 * b.cage->diagonal);
  }
}

TEST_CASE("the_error_map_samples_the_matrices_exponentiated_under_a_mask") {
  Bound b(shared_model(), tube(7, 12, 0.6, 2));
  b.deformer.set_mask(ramp(b.model));
  b.deform(b.pose(shear()), sym3::Method::diag);
  const auto matrices = b.deformer.sample_matrices(b.model.positions.size());
  REQUIRE(matrices.size() == b.model.positions.size());
  const auto log = matrices[0];
  CHECK(std::abs(log.xx) + std::abs(log.xy) == 0);  // at the fixed end
  CHECK(std::abs(matrices.back().xx) > 0.01);
}
