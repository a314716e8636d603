// Moves a shape with the cage, for cages whose rows have no rotations.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "deform/fused_engine.h"
#include "deform/staged_engine.h"
#include "pose/cage_state.h"

namespace viete::deform {

/// Moves each displacement v of a shape with the cage: v' = v + share * (sum w * (M - I)) * v. M is the map
/// of the patch around a vertex of the cage, and w is the weight of this vertex. If the cage moves by an
/// affine map and share is 1, v' is the linear part of this map times v. Not thread-safe.
class ShapeFollower {
public:
  /// Returns true if the deformer's rows are positions, which have no rotations.
  static bool is_for(const pose::Deformer& deformer) {
    return row_form(deformer.weighting.elements, deformer.blend) == pose::RowForm::positions;
  }

  explicit ShapeFollower(std::shared_ptr<const pose::Cage> cage)
      : state_(std::move(cage), pose::Elements::point, pose::RowForm::maps) {}

  void set_pose(const pose::Pose& pose) { state_.set_pose(pose); }
  /// Returns v' for all vertices. The mask scales the shares. Uses tiles if the binding has them.
  std::span<const Vec3> followed(const std::shared_ptr<const weights::Binding>& binding,
                                 const weights::Mask& mask, std::span<const Vec3> displacements,
                                 base::WorkerPool& pool);
  /// Returns v' for a block's vertices. block.displacements must be empty. Thread-safe between calls of
  /// set_pose().
  std::vector<Vec3> followed(const weights::VertexBlock& block, std::span<const Vec3> displacements) const;

private:
  std::vector<Vec3> followed(std::span<const double> sums, std::span<const Vec3> displacements) const;

  pose::CageState state_;
  std::unique_ptr<FusedEngine> blender_;  // for a binding with tiles
  weights::Mask mask_;
  std::vector<double> sums_;
  std::vector<Vec3> followed_;
};

}  // namespace viete::deform
