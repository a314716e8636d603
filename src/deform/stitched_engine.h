// The frame of a stitched model: the positions whose triangles follow the blended maps most closely.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "deform/cage_state.h"
#include "deform/engine.h"
#include "deform/fused_engine.h"
#include "deform/stitching.h"
#include "sym3/exp.h"

namespace viete::deform {

/// The buffers of stitched frames. Not thread-safe; the same bits for any number of threads.
class Stitcher {
public:
  /// The form must be logs or maps. Both must outlive this.
  Stitcher(const Stitching& stitching, RowForm form, base::WorkerPool& pool);

  /// Of the next poses, one a vertex; empty: all 1. Pins take part in what their vertices make of them.
  void set_shares(const Shares& shares);
  /// Of the next poses, one way a vertex: see Engine::set_shape(). Gradients are of the shape's sides, with
  /// the cotangents at rest.
  void set_shape(std::span<const Vec3> ways);
  /// One pose. sums, shared already, are the blended rows, [vertex][column]; held, of each hold, the vertex's
  /// blended position relative to the rows' origin. A triangle's map is that of the mean of its corners'
  /// sums.
  ///
  /// iterations, 1 or more: how often positions are solved for. Before each time but the first, the rotations
  /// R_t are replaced by those that fit the positions best, the stretches S_t staying as they are (O.
  /// Sorkine, M. Alexa, As-rigid- as-possible surface modeling, 2007): the energy above never grows.
  void run(const Rows& rows, std::span<const double> sums, std::span<const Vec3> held, sym3::Method method,
           int iterations);

  /// Relative to the rows' origin.
  std::span<const Vec3> positions() const { return positions_; }
  /// Of the last frame: maps and their loads, and solving, in milliseconds of wall time.
  double loads_ms() const { return loads_ms_; }
  double solve_ms() const { return solve_ms_; }

private:
  struct Maps;

  void load_blended(std::span<const double> sums, sym3::Method method, bool keep_stretches);
  void load_refitted();
  void set_load(std::size_t triangle, const Vec3& a, const Vec3& b);
  void place_pins(const Rows& rows, sym3::Method method);
  void solve(std::span<const Vec3> held);

  const Stitching& stitching_;
  RowForm form_;
  base::WorkerPool& pool_;
  std::vector<std::array<Vec3, 2>> shaped_gradients_;  // empty: those at rest
  std::vector<Vec3> loads_;                            // M g of each corner of each triangle
  std::vector<std::array<Vec3, 2>> stretched_;         // S g, where rotations are refitted
  Binding pinned_;                                     // with the shares of the pins' vertices
  std::vector<mesh::Point> pin_targets_;
  std::vector<Vec3> right_, positions_;
  SparseCholesky::Workspace work_;
  double loads_ms_ = 0, solve_ms_ = 0;
};

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
