#include "deform/bound.h"

using namespace viete;
using namespace viete::test;

namespace {

mesh::Surface shaped_model() {
  return tube(30, 20, 0.3, 3);
}

// Returns the model after bending it, making one end thicker, and moving it.
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

Frames shaped_frames(const Deformer& deformer) {
  return Frames(shaped_model(), tube(9, 7, 0.4, 2.2), deformer);
}

std::vector<Deformer> shaped_deformers() {
  std::vector<Deformer> all = whole_deformers();
  for (const Preset preset : base::all_values<Preset>()) all.push_back(deformer_of(preset));
  return all;
}

const Twist shaped_twist{2, {0.1, 0, 0}, -1.1, 1.1, -60 * degree, 70 * degree};

}  // namespace

TEST_CASE("shapes_follow_similarities_and_without_one_the_model_is_the_same_to_the_bit") {
  for (const Deformer& deformer : shaped_deformers()) {
    CAPTURE(text(deformer));
    Frames f = shaped_frames(deformer);
    const SharedShape shape = bent(f.staged.model);
    const Pose pose = f.staged.pose(shaped_twist);
    const auto before = f.deform(pose);
    f.set_shape(shape);
    CHECK(largest_distance(f.deform(rest_pose(*f.staged.cage)), *shape) < 1e-12 * f.staged.cage->diagonal);
    if (!deformer.weighting.partial()) {
      const double grown = deformer.blend == Blend::mls_rigid ? 1 : 1.5;
      const auto turned = similarity({1, -2, 3}, 80 * degree, grown, {1, 0.5, -2});
      CHECK(largest_distance(f.deform(f.staged.pose(turned)), mapped(*shape, turned)) <
            1e-10 * f.staged.cage->diagonal);
    }
    f.set_shape(nullptr);
    CHECK(f.deform(pose) == before);
    f.set_shape(std::make_shared<const std::vector<mesh::Point>>(f.staged.model.positions));
    CHECK(f.deform(pose) == before);
  }
}

TEST_CASE("vertices_that_do_not_follow_the_cage_keep_the_shape") {
  Frames f = shaped_frames({faces});
  const SharedShape shape = bent(f.staged.model);
  const Mask mask = half_of_it(f.staged.model);
  f.set_mask(mask);
  f.set_shape(shape);
  const auto posed = f.deform(f.staged.pose([](const Vec3& x) { return x + Vec3{1, 2, 3}; }));
  for (std::size_t i = 0; i < posed.size(); ++i)
    CHECK(norm(posed[i] - ((*shape)[i] + double((*mask)[i]) * Vec3{1, 2, 3})) < 1e-12);
}

TEST_CASE("a_shape_change_during_a_drag_takes_effect_at_once") {
  Frames f = shaped_frames({faces});
  Pose pose = f.staged.pose(shaped_twist);
  f.deform(pose);
  f.fused.begin_drag(std::array{3u});
  for (int i = 0; i < 3; ++i) {
    pose.positions[3][0] += 0.05;
    f.set_shape(i == 1 ? bent(f.staged.model) : nullptr);
    f.deform(pose);
  }
}
