// Frames of a stitched model: from blended sums to the positions that follow them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "deform/cage_state.h"
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

}  // namespace viete::deform
