// Moves a shape with the cage, for cages whose rows have no rotations.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "deform/cage_state.h"
#include "deform/fused_engine.h"
#include "deform/staged_engine.h"

namespace viete::deform {

/// Moves each displacement v of a shape with the cage: v' = v + share * (sum w * (M - I)) * v. M is the map
/// of the patch around a vertex of the cage, and w is the weight of this vertex. If the cage moves by an
/// affine map and share is 1, v' is the linear part of this map times v. Not thread-safe.
class ShapeFollower {
public:
  /// Returns true if the scheme's rows are positions, which have no rotations.
  static bool is_for(const Scheme& scheme) {
    return row_form(scheme.weighting.elements, scheme.blend) == RowForm::positions;
  }

  explicit ShapeFollower(std::shared_ptr<const Cage> cage)
      : state_(std::move(cage), Elements::point, RowForm::maps) {}

  void set_pose(const Pose& pose) { state_.set_pose(pose); }
  /// Returns v' for all vertices. The mask scales the shares. Uses tiles if the binding has them.
  std::span<const Vec3> followed(const std::shared_ptr<const Binding>& binding, const Mask& mask,
                                 std::span<const Vec3> ways, base::WorkerPool& pool);
  /// Returns v' for a block's vertices. block.ways must be empty. Thread-safe between calls of set_pose().
  std::vector<Vec3> followed(const VertexBlock& block, std::span<const Vec3> ways) const;

private:
  std::vector<Vec3> followed(std::span<const double> sums, std::span<const Vec3> ways) const;

  CageState state_;
  std::unique_ptr<FusedEngine> blender_;  // for a binding with tiles
  Mask mask_;
  std::vector<double> sums_;
  std::vector<Vec3> followed_;
};

}  // namespace viete::deform
