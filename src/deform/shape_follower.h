// Displacements of a shape that follow a cage whose elements only translate, since their rows hold no
// rotation.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "deform/cage_state.h"
#include "deform/fused_engine.h"
#include "deform/staged_engine.h"

namespace viete::deform {

/// Displacements v of a shape, moved along with the cage: v' = v + share sum w (M - I) v, M being the maps of
/// the patches around the cage's vertices and w the weights of the points. For an affine motion of the cage,
/// v' is its linear part applied to v. Not thread-safe.
class ShapeFollower {
public:
  /// True if rows are positions; other forms have maps of their own.
  static bool is_for(const Scheme& scheme) {
    return row_form(scheme.weighting.elements, scheme.blend) == RowForm::positions;
  }

  explicit ShapeFollower(std::shared_ptr<const Cage> cage)
      : state_(std::move(cage), Elements::point, RowForm::maps) {}

  void set_pose(const Pose& pose) { state_.set_pose(pose); }
  /// For all vertices of a binding, masked; by its tiles if it has them.
  std::span<const Vec3> followed(const Binding& binding, const Mask& mask, std::span<const Vec3> ways,
                                 base::WorkerPool& pool);
  /// For the vertices of a block with weights and without ways. Thread-safe between poses.
  std::vector<Vec3> followed(const VertexBlock& block, std::span<const Vec3> ways) const;

private:
  std::vector<Vec3> followed(std::span<const double> sums, std::span<const Vec3> ways) const;

  CageState state_;
  std::unique_ptr<FusedEngine> blender_;  // of the tiles
  Mask mask_;
  std::vector<double> sums_;
  std::vector<Vec3> followed_;
};

}  // namespace viete::deform
