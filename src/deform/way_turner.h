// What elements that only move do to directions: their rows do not tell, and a shape has to turn with the
// cage.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "deform/binding.h"
#include "deform/cage_state.h"
#include "deform/fused_engine.h"

namespace viete::deform {

/// Ways of a shape, v, as the cage takes them along: v' = v + share sum w (M - I) v, M being the maps of the
/// patches about the cage's vertices, whose weights are those of the points. Where these make an affine
/// motion, v' is what that does to v. Not thread-safe.
class WayTurner {
public:
  /// True if rows are positions; other forms have maps of their own.
  static bool is_for(const Scheme& scheme) {
    return row_form(scheme.weighting.elements, scheme.blend) == RowForm::positions;
  }

  explicit WayTurner(std::shared_ptr<const Cage> cage)
      : state_(std::move(cage), Elements::point, RowForm::maps) {}

  void set_pose(const Pose& pose) { state_.set_pose(pose); }
  /// Of all vertices of a binding with tiles, masked.
  std::span<const Vec3> turned(const Binding& binding, const Mask& mask, std::span<const Vec3> ways,
                               base::WorkerPool& pool);
  /// Of those of one that has weights. Thread-safe between poses.
  std::vector<Vec3> turned(const Binding& binding, const Shares& shares, std::span<const Vec3> ways) const;

private:
  CageState state_;
  std::unique_ptr<FusedEngine> blender_;  // of the tiles
  Mask mask_;
  std::vector<double> sums_;
  std::vector<Vec3> turned_;
};

}  // namespace viete::deform
