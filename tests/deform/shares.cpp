// Tests vertices that follow only a part of their motion, because of partial weights or a mask.
#include "deform/bound.h"

using namespace viete;
using namespace viete::test;

namespace {

mesh::Surface shared_model() {
  return tube(40, 24, 0.3, 3);
}

// Returns mask values from 0 at one end to 1 at the other end.
Mask ramp(const mesh::Surface& model) {
  std::vector<float> mask;
  for (const auto& p : model.positions)
    mask.push_back(static_cast<float>(std::clamp(p[2] / 2 + 0.5, 0.0, 1.0)));
  return std::make_shared<const std::vector<float>>(std::move(mask));
}

Mask everywhere(float share) {
  return std::make_shared<const std::vector<float>>(shared_model().positions.size(), share);
}

Frames shared_frames(const Deformer& deformer, const mesh::Surface& cage = tube(9, 7, 0.4, 2.2)) {
  return Frames(shared_model(), cage, deformer);
}

const Twist shared_twist{2, {0.1, 0, 0}, -1.1, 1.1, -60 * degree, 70 * degree};

}  // namespace

TEST_CASE("a_mask_of_ones_changes_nothing_and_one_of_zeros_leaves_the_model_at_rest") {
  auto deformers = whole_deformers();
  for (const int iterations : {1, 3}) deformers.push_back({.weighting = {}, .iterations = iterations});
  for (const Deformer& deformer : deformers) {
    CAPTURE(text(deformer));
    Frames f = shared_frames(deformer);
    const Pose pose = f.staged.pose(shared_twist);
    const auto whole = f.deform(pose);
    const double solved = deformer.stitched() ? 1e-10 : 0, diagonal = f.staged.cage->diagonal;
    f.set_mask(everywhere(1));
    CHECK(largest_distance(f.deform(pose), whole) < (1e-12 + solved) * diagonal);
    f.set_mask(everywhere(0));
    CHECK(largest_distance(f.deform(pose), f.staged.model.positions) < (1e-14 + solved) * diagonal);
    f.set_mask(ramp(f.staged.model));
    f.deform(pose);
    f.set_mask(nullptr);
    CHECK(largest_distance(f.deform(pose), whole) == 0);
  }
}

TEST_CASE("shares_scale_translations_and_linearly_blended_rotations") {
  const Vec3 shift{3, -1, 2};
  const auto moved = [&](const Vec3& x) { return x + shift; };
  const auto turned = similarity({1, -2, 3}, 80 * degree);
  for (const Deformer& deformer : whole_deformers()) {
    CAPTURE(text(deformer));
    Frames f = shared_frames(deformer);
    f.set_mask(ramp(f.staged.model));
    const auto& rest = f.staged.model.positions;
    const auto by_shift = f.deform(f.staged.pose(moved)), by_turn = f.deform(f.staged.pose(turned));
    for (std::size_t i = 0; i < rest.size(); i += 7) {
      const double s = static_cast<double>((*f.mask)[i]);
      CHECK(norm(by_shift[i] - (rest[i] + s * shift)) < 1e-12);
      const Vec3 straight = (1 - s) * rest[i] + s * turned(rest[i]);
      if (deformer.blend == Blend::linear) CHECK(norm(by_turn[i] - straight) < 1e-12);
    }
  }
}

TEST_CASE("shares_scale_rotation_stretch_and_translation_about_the_centre_of_the_handles") {
  const auto turned = similarity({1, -2, 3}, 80 * degree, 1.5, {1, 0.5, -2});
  Frames f = shared_frames({faces});
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
  const Vec3 shift{1000, -2000, 500};
  const auto there = [&](const mesh::Surface& surface) { return mapped(surface, scaling(1, shift)); };
  for (const Weighting& weighting : {test::cut_off(0.1), faces}) {
    Frames here = shared_frames({weighting});
    Bound moved(there(shared_model()), there(tube(9, 7, 0.4, 2.2)), weighting);
    here.set_mask(ramp(here.staged.model));
    moved.deformer.set_mask(here.mask);
    const auto a = here.deform(here.staged.pose(shared_twist));
    const auto b = moved.deform(moved.pose([&](const Vec3& x) { return shared_twist(x - shift) + shift; }));
    CHECK(largest_distance(mapped(a, [&](const Vec3& x) { return x + shift; }), b) < 1e-11);
  }
}

TEST_CASE("vertices_follow_within_the_cut_off_radius_without_a_jump_and_keep_every_bit_beyond") {
  for (Deformer deformer : valid_deformers()) {
    if (!deformer.weighting.partial()) continue;
    CAPTURE(text(deformer));
    deformer.weighting.radius = 0.08;
    Frames f = shared_frames(deformer);
    const auto posed = f.deform(f.staged.pose(similarity({0, 0, 1}, 30 * degree, 1.1, {0.2, 0, 0})));
    CHECK(largest_edge_stretch(f.staged.model, posed) < 5);
    const auto& shares = f.staged.binding->shares;
    std::size_t staying = 0, partly = 0;
    for (std::size_t i = 0; i < posed.size(); ++i) {
      const double distance = norm(posed[i] - f.staged.model.positions[i]);
      if (shares[i] == 0) CHECK(distance < 1e-15);
      if (shares[i] > 0.5) CHECK(distance > 0.01);
      staying += shares[i] == 0;
      partly += shares[i] > 0 && shares[i] < 1;
    }
    CHECK(staying > 20);
    CHECK(partly > 20);
    // A mask scales the shares. With a radius larger than the cage, all shares are 1 and are not stored.
    f.set_mask(everywhere(0.5f));
    f.deform(f.staged.pose(shared_twist));
    deformer.weighting.radius = number("radius").largest;
    CHECK(shared_frames(deformer).staged.binding->shares.empty());
  }
}

TEST_CASE("a_masked_drag_equals_a_full_frame_even_when_the_mask_changes") {
  for (const Weighting& weighting : {faces, test::cut_off(0.15)}) {
    Frames f = shared_frames({weighting}, tube(20, 12, 0.6, 3));
    Pose pose = f.staged.pose(shared_twist);
    f.set_mask(ramp(f.staged.model));
    f.deform(pose);
    f.fused.begin_drag(std::array{100u});
    for (int step = 0; step < 6; ++step) {
      pose.positions[100][0] += 0.03;
      if (step == 3) f.set_mask(everywhere(0.4f));
      f.deform(pose);
    }
  }
}

TEST_CASE("the_error_map_samples_the_matrices_exponentiated_under_a_mask") {
  Bound b(shared_model(), tube(7, 12, 0.6, 2));
  b.deformer.set_mask(ramp(b.model));
  b.deform(b.pose(shear()), sym3::Method::diag);
  const auto matrices = b.deformer.sample_matrices(b.model.positions.size());
  REQUIRE(matrices.size() == b.model.positions.size());
  CHECK(std::abs(matrices[0].xx) + std::abs(matrices[0].xy) == 0);  // at the fixed end
  CHECK(std::abs(matrices.back().xx) > 0.01);
}
