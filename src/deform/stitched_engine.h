// Frames of a stitched model: the positions whose triangles follow the blended maps most closely.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "deform/engine.h"
#include "deform/fused_engine.h"
#include "deform/stitching.h"
#include "pose/cage_state.h"
#include "sym3/exp.h"

namespace viete::deform {

/// Computes stitched frames. Not thread-safe. Results do not depend on the number of threads.
class Stitcher {
public:
  /// form must be logs or maps. stitching and pool must outlive this object.
  Stitcher(const Stitching& stitching, pose::RowForm form, base::WorkerPool& pool);

  /// Sets the shares of the next poses, one per vertex; empty: all are 1. Shares also scale pins' motions.
  void set_shares(const weights::Shares& shares);
  /// Sets the shape of the next poses: one displacement per vertex, see Engine::set_shape(). The
  /// displacements change the edges of the model, but not the cotangents of its triangles.
  void set_shape(std::span<const Vec3> displacements);
  /// Computes one pose. sums[vertex][column] are the blended rows with shares applied. A triangle's map is
  /// computed from the mean of the corners' sums. `held` has the blended positions of the vertices in
  /// Stitching::holds, relative to the rows' origin.
  ///
  /// `iterations`, 1 or more, is the number of solves. Before each solve after the first, the rotations R_t
  /// are replaced by the rotations that best fit the positions. The stretches S_t do not change (O. Sorkine,
  /// M. Alexa, As-rigid-as-possible surface modeling, 2007). The energy never increases.
  void run(const pose::Rows& rows, std::span<const double> sums, std::span<const Vec3> held,
           sym3::Method method, int iterations);

  /// Positions relative to the rows' origin.
  std::span<const Vec3> positions() const { return std::span(positions_).first(stitching_.vertices()); }
  /// Wall times of the last frame in milliseconds.
  double loads_ms() const { return loads_ms_; }  ///< for triangles' maps and the terms M * g
  double solve_ms() const { return solve_ms_; }

private:
  struct Maps;

  void load_blended(std::span<const double> sums, sym3::Method method, bool keep_stretches);
  void load_refitted();
  void set_load(std::size_t triangle, const Vec3& a, const Vec3& b);
  void place_pins(const pose::Rows& rows, sym3::Method method);
  void solve(std::span<const Vec3> held);

  const Stitching& stitching_;
  pose::RowForm form_;
  base::WorkerPool& pool_;
  std::vector<std::array<Vec3, 2>> shaped_gradients_;  // empty without a shape
  std::vector<Vec3> loads_;                            // M * g of each corner, see Stitching
  std::vector<std::array<Vec3, 2>> stretched_;         // S * g; empty if rotations are not refitted
  weights::Shares pin_shares_;                         // one per pin
  std::vector<Vec3> pin_displacements_;
  std::vector<mesh::Point> pin_targets_;
  std::vector<Vec3> right_, positions_;
  sparse::SparseCholesky::Workspace work_;
  double loads_ms_ = 0, solve_ms_ = 0;
};

/// Computes stitched frames. The fused engine computes the sums in float and, if there is a coarse model, the
/// blended positions of the whole model, with method `fast`. All later steps have double precision. Poses
/// need no factorisation. The result agrees with deform_exactly() up to the error of the sums: 1e-6 of the
/// diagonal, or the fused engine's error with compressed weights.
class StitchedEngine : public Engine {
public:
  /// `binding` must have tiles. `binding` and `stitching` must belong to the same model, cage and kind of
  /// elements and, if there is a coarse model, have the same weighting. `form` must be logs or maps, and
  /// `iterations` must be 1 or more.
  StitchedEngine(std::shared_ptr<const weights::Binding> binding, std::shared_ptr<const Stitching> stitching,
                 pose::RowForm form, int iterations, base::WorkerPool& pool);

  void set_mask(const weights::Mask& mask) override;
  void set_shape(std::span<const Vec3> displacements) override;
  void run(const pose::CageState& state, sym3::Method method) override;
  std::span<const pose::FrameVertex> vertices() const override {
    return (whole_ ? *whole_ : blender_).vertices();
  }
  /// Positions of the last frame, relative to the rows' origin.
  std::span<const Vec3> positions() const { return whole_ ? positions_ : stitcher_.positions(); }

  /// As positions(), but before stitching and only at spread_vertices(n, error_sample).
  std::vector<Vec3> blended_sample() const;

private:
  std::vector<Vec3> blended(std::span<const std::size_t> vertices, sym3::Method method) const;
  pose::StageTimes move_whole(const pose::CageState& state, sym3::Method method);

  // If there is a coarse model, all members are of this model, except for whole_, positions_ and sample_.
  std::unique_ptr<FusedEngine> whole_;
  std::vector<Vec3> positions_, sample_, coarse_displacements_;
  base::WorkerPool& pool_;
  std::shared_ptr<const weights::Binding> bound_;
  std::shared_ptr<const weights::TiledBinding> binding_;
  std::shared_ptr<const Stitching> stitching_;
  pose::RowForm form_;
  int iterations_;
  FusedEngine blender_;
  Stitcher stitcher_;
  std::vector<std::uint32_t> slots_;  // slot of each vertex
  std::vector<std::size_t> held_;     // the vertices with holds
  weights::Mask mask_;                // of the whole model
  weights::Shares shares_;
  std::span<const Vec3> displacements_;  // displacements of the shape
  std::vector<double> sums_;
};

}  // namespace viete::deform
