// Shapes deformed by a cage: every engine, and models without a shape.
#include <doctest/doctest.h>

#include "deform/binding.h"
#include "deform/bound.h"
#include "deform/exact.h"
#include "deform/scheme.h"
#include "deform/stitching.h"

using namespace viete;
using namespace viete::test;

namespace {

constexpr auto shaped_fast = sym3::Method::fast;

mesh::Surface shaped_model() {
  return tube(30, 20, 0.3, 3);
}

// Bent, thickened at one end, and moved.
SharedShape bent(const mesh::Surface& model) {
  std::vector<mesh::Point> shape;
  for (const auto& p : model.positions) {
    const double angle = 0.5 * p[2], thick = 1 + 0.2 * p[2];
    shape.push_back({thick * p[0] + 0.1, thick * p[1] * std::cos(angle) - 0.2 * std::sin(angle),
                     p[2] + 0.3 * p[1] * std::sin(angle)});
  }
  return std::make_shared<const std::vector<mesh::Point>>(std::move(shape));
}

Mask half_of_it(const mesh::Surface& model) {
  std::vector<float> mask;
  for (const auto& p : model.positions) mask.push_back(p[2] > 0 ? 1.0f : 0.4f);
  return std::make_shared<const std::vector<float>>(std::move(mask));
}

struct ShapedFrames {
  explicit ShapedFrames(const Scheme& scheme_)
      : scheme(scheme_),
        staged(shaped_model(), tube(9, 7, 0.4, 2.2), scheme.weighting, 2, scheme.blend),
        shape(bent(staged.model)),
        stitching(scheme.stitched() ? std::make_shared<const Stitching>(stitch(
                                          staged.model, *staged.cage, staged.pool, settings_of(scheme)))
                                    : nullptr),
        fused(staged.cage,
              std::make_shared<const Binding>(bind(staged.model, *staged.cage, scheme.weighting,
                                                   EngineKind::fused, nullptr, staged.pool)),
              scheme, staged.pool, stitching),
        exact(staged.model, staged.cage, scheme, shaped_fast, staged.pool, ExactDeformer::Weights::kept) {}

  // The result of all engines, which must agree.
  std::vector<mesh::Point> deform(const Pose& pose, const SharedShape& of) {
    const double far = std::max(staged.cage->diagonal, mesh::bounds(pose.positions).diagonal());
    const auto positions = exact.deform(pose, {}, of).positions;
    fused.set_shape(of);
    fused.deform(pose, shaped_fast);
    CHECK(largest_distance(fused.positions(), positions) < 2e-5 * far);
    CHECK(fused.sampled_error() < 2e-5);
    if (scheme.stitched()) return positions;
    staged.deformer.set_shape(of);
    CHECK(largest_distance(staged.deform(pose), positions) < 1e-12 * far);
    return positions;
  }

  Scheme scheme;
  Bound staged;
  SharedShape shape;
  std::shared_ptr<const Stitching> stitching;
  Deformer fused;
  ExactDeformer exact;
};

std::vector<Scheme> shaped_schemes() {
  std::vector<Scheme> all = whole_schemes();
  for (const WayEntry& way : all_ways()) all.push_back(way.scheme);
  return all;
}

const Twist shaped_twist{2, {0.1, 0, 0}, -1.1, 1.1, -60 * degree, 70 * degree};

}  // namespace

TEST_CASE("a_cage_at_rest_keeps_the_shape_or_without_one_the_model_to_the_bit") {
  for (const Scheme& scheme : shaped_schemes()) {
    CAPTURE(text(scheme));
    ShapedFrames f(scheme);
    const Pose rest = rest_pose(*f.staged.cage), pose = f.staged.pose(shaped_twist);
    const auto before = f.deform(pose, nullptr);
    CHECK(largest_distance(f.deform(rest, f.shape), *f.shape) < 1e-12 * f.staged.cage->diagonal);
    CHECK(f.deform(pose, nullptr) == before);
    const auto at_rest = std::make_shared<const std::vector<mesh::Point>>(f.staged.model.positions);
    CHECK(f.deform(pose, at_rest) == before);
  }
}

TEST_CASE("a_similarity_of_the_cage_transforms_the_shape") {
  for (const Scheme& scheme : shaped_schemes()) {
    if (scheme.weighting.partial()) continue;
    const double grown = scheme.blend == Blend::mls_rigid ? 1 : 1.5;
    const auto turned = similarity({1, -2, 3}, 80 * degree, grown, {1, 0.5, -2});
    CAPTURE(text(scheme));
    ShapedFrames f(scheme);
    const auto posed = f.deform(f.staged.pose(turned), f.shape);
    double off = 0;
    for (std::size_t i = 0; i < posed.size(); ++i)
      off = std::max(off, norm(posed[i] - turned((*f.shape)[i])));
    CHECK(off < 1e-10 * f.staged.cage->diagonal);
  }
}

TEST_CASE("vertices_that_do_not_follow_the_cage_keep_the_shape") {
  ShapedFrames f({faces});
  const Mask mask = half_of_it(f.staged.model);
  f.staged.deformer.set_mask(mask), f.fused.set_mask(mask);
  const Pose pose = f.staged.pose([](const Vec3& x) { return x + Vec3{1, 2, 3}; });
  f.staged.deformer.set_shape(f.shape), f.fused.set_shape(f.shape);
  const auto staged = f.staged.deform(pose);
  f.fused.deform(pose, shaped_fast);
  CHECK(largest_distance(f.fused.positions(), staged) < 1e-5);
  for (std::size_t i = 0; i < staged.size(); ++i)
    CHECK(norm(staged[i] - ((*f.shape)[i] + double((*mask)[i]) * Vec3{1, 2, 3})) < 1e-12);
}

TEST_CASE("a_shape_change_during_a_drag_takes_effect_at_once") {
  ShapedFrames f({faces});
  Pose pose = f.staged.pose(shaped_twist);
  f.fused.deform(pose, shaped_fast);
  const std::vector<std::uint32_t> held{3};
  f.fused.begin_drag(held);
  for (int i = 0; i < 3; ++i) {
    pose.positions[3][0] += 0.05;
    f.fused.set_shape(i == 1 ? f.shape : nullptr);
    f.fused.deform(pose, shaped_fast);
    const auto exact = f.exact.deform(pose, {}, i == 1 ? f.shape : nullptr).positions;
    CHECK(largest_distance(f.fused.positions(), exact) < 2e-5 * f.staged.cage->diagonal);
  }
}
