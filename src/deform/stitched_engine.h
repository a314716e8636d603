// The frame of a stitched model: blended rows in, positions that their triangles' maps follow best out.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "deform/engine.h"
#include "deform/fused_engine.h"
#include "deform/stitcher.h"

namespace viete::deform {

/// Sums in float, as the fused engine forms them, compressed or while something is dragged; all that follows
/// in double: maps of triangles, the solution, its positions. Nothing is factored for a pose. Agrees with
/// deform_exactly() to what the sums lose: 1e-6 of the diagonal, with compressed weights as the fused engine
/// does.
class StitchedEngine : public Engine {
public:
  /// Neither may be null; of the same model, cage and elements. form logs or maps; iterations 1 or more.
  StitchedEngine(std::shared_ptr<const TiledBinding> binding, std::shared_ptr<const Stitching> stitching,
                 RowForm form, int iterations, base::WorkerPool& pool);

  void set_mask(const Mask& mask) override;
  void set_shape(std::span<const Vec3> ways) override;
  void run(const CageState& state, sym3::Method method) override;
  std::span<const FrameVertex> vertices() const override { return blender_.vertices(); }
  /// Of the last frame, in double, relative to its rows' origin.
  std::span<const Vec3> positions() const { return stitcher_.positions(); }

  /// These vertices as the last frame has blended them, not stitched; relative to its rows' origin.
  std::vector<Vec3> blended(std::span<const std::size_t> vertices) const;

private:
  void place_held(std::span<const double> sums, sym3::Method method);

  std::shared_ptr<const TiledBinding> binding_;
  std::shared_ptr<const Stitching> stitching_;
  RowForm form_;
  int iterations_;
  FusedEngine blender_;
  Stitcher stitcher_;
  std::vector<std::uint32_t> slots_;  // of vertices
  Shares shares_;
  std::span<const Vec3> ways_;  // of the shape
  Binding held_;                // what apply() needs of the vertices that are held
  std::vector<double> sums_, held_sums_;
  std::vector<Vec3> held_positions_;
};

}  // namespace viete::deform
