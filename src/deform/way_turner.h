// Rotation of a shape's displacements along with a cage whose elements only translate, since their rows hold
// no rotation.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "deform/binding.h"
#include "deform/cage_state.h"
#include "deform/fused_engine.h"

namespace viete::deform {

/// Displacements v of a shape, moved along with the cage: v' = v + share sum w (M - I) v, M being the maps of
/// the patches around the cage's vertices and w the weights of the points. For an affine motion of the cage,
/// v' is its linear part applied to v. Not thread-safe.
class WayTurner {
public:
  /// True if rows are positions; other forms have maps of their own.
  static bool is_for(const Scheme& scheme) {
    return row_form(scheme.weighting.elements, scheme.blend) == RowForm::positions;
  }

  explicit WayTurner(std::shared_ptr<const Cage> cage)
      : state_(std::move(cage), Elements::point, RowForm::maps) {}

  void set_pose(const Pose& pose) { state_.set_pose(pose); }
  /// For all vertices of a binding with tiles, masked.
  std::span<const Vec3> turned(const Binding& binding, const Mask& mask, std::span<const Vec3> ways,
                               base::WorkerPool& pool);
  /// For the vertices of a binding with weights. Thread-safe between poses.
  std::vector<Vec3> turned(const Binding& binding, const Shares& shares, std::span<const Vec3> ways) const;

private:
  CageState state_;
  std::unique_ptr<FusedEngine> blender_;  // blender of the tiles
  Mask mask_;
  std::vector<double> sums_;
  std::vector<Vec3> turned_;
};

}  // namespace viete::deform
