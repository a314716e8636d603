#include "deform/shape_follower.h"

namespace viete::deform {

// Returns v' for each v in `displacements`, see ShapeFollower. `sums` has share * (sum w * (M - I)) by rows.
std::vector<Vec3> ShapeFollower::followed(std::span<const double> sums,
                                          std::span<const Vec3> displacements) const {
  std::vector<Vec3> all;
  all.reserve(displacements.size());
  for (std::size_t v = 0; v < displacements.size(); ++v) {
    const double* m = sums.data() + v * pose::map_shape.columns;
    const auto row = [&, &way = displacements[v]](std::size_t i) {
      return m[3 * i] * way[0] + m[3 * i + 1] * way[1] + m[3 * i + 2] * way[2];
    };
    all.push_back(displacements[v] + Vec3{row(0), row(1), row(2)});
  }
  return all;
}

std::span<const Vec3> ShapeFollower::followed(const std::shared_ptr<const weights::Binding>& binding,
                                              const weights::Mask& mask, std::span<const Vec3> displacements,
                                              base::WorkerPool& pool) {
  if (!binding->tiles)
    return followed_ =
               followed({*binding, weights::product(binding->shares, weights::values(mask))}, displacements);
  if (!blender_) blender_ = std::make_unique<FusedEngine>(binding, state_.rows().form, pool);
  if (mask_ != mask) blender_->set_mask(mask);
  mask_ = mask;
  sums_.resize(displacements.size() * pose::map_shape.columns);
  blender_->blend(state_, sums_);
  return followed_ = followed(sums_, displacements);
}

std::vector<Vec3> ShapeFollower::followed(const weights::VertexBlock& block,
                                          std::span<const Vec3> displacements) const {
  std::vector<double> sums(displacements.size() * pose::map_shape.columns);
  blend(block, state_.rows(), 0, displacements.size(), sums);
  return followed(sums, displacements);
}

}  // namespace viete::deform
