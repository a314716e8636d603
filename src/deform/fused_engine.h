// The fastest engine: computes vertices from cage rows in one pass, without intermediate arrays.
#pragma once

#include <memory>
#include <span>

#include "base/clock.h"
#include "base/worker_pool.h"
#include "deform/engine.h"
#include "deform/frame_kernel.h"
#include "deform/probe_layer.h"
#include "weights/tiled_binding.h"

namespace viete::deform {

/// Computes the frame of the staged engine with method `fast`, but in float and in one pass over the weights.
/// The engines' positions differ by at most 1e-6 of the diagonal (2e-6 for moments with cut-off weights),
/// plus twice the compression tolerance.
///
/// If at most a quarter of the handles move in a drag, and weights have more factors than rows have columns,
/// the cost is proportional to the number of moved handles. The first frame of the drag stores the sums of
/// all other handles. Later frames add the moved rows, and skip leaves where no moved handle has weight. Up
/// to rounding, the results equal full frames.
///
/// Vertices where no moved handle has weight keep all bits under two conditions: weights are not compressed,
/// and the pose's origin (see pose_origin) and the mean of the rows do not change.
///
/// Moment forms (see moments.h) need uncompressed weights. With these forms, the first frame also computes
/// data that do not depend on the pose, and takes three times as long as later frames.
class FusedEngine : public Engine {
public:
  /// `binding` must have tiles.
  FusedEngine(std::shared_ptr<const weights::Binding> binding, pose::RowForm form, base::WorkerPool& pool,
              const sym3::Kernel& kernel = sym3::kernel());

  void set_mask(const weights::Mask& mask) override;
  void set_shape(std::span<const Vec3> displacements) override;
  /// Always uses method `fast`.
  void run(const pose::CageState& state, sym3::Method method = sym3::Method::fast) override;
  std::span<const pose::FrameVertex> vertices() const override { return vertices_; }
  /// First half of a frame: writes each vertex's sums of rows, multiplied by its share, to sums
  /// [vertex][column] in file order. Lengths have the unit of the rows.
  void blend(const pose::CageState& state, std::span<double> sums);
  /// Second half of a frame: fills vertices() from positions relative to the origin of the rows.
  void show(std::span<const Vec3> positions);
  /// Returns true if the last frame used cached sums and added only the moved handles.
  bool dragging() const { return dragging_; }
  /// Returns the bytes of weights, factors and cached data that the last frame read.
  std::size_t bytes() const;

private:
  using Handles = std::span<const std::uint32_t>;

  const base::AlignedVector<float>& offsets() const {
    return offsets_.empty() ? binding_->offsets : offsets_;
  }
  void prepare(const pose::CageState& state);
  void fill_table(const pose::Rows& rows);
  void fill_rest();
  void fill_rest_moments(const pose::Rows& rows);
  void fill_rest_moments(std::size_t leaf, double unit);
  void choose_mean();
  void follow_drag(const pose::CageState& state);
  bool few_factors(std::size_t moving) const;
  void begin_drag(Handles moving);
  std::size_t list_moving();
  void pack_whole(std::size_t leaf);
  void pack_weights(std::size_t leaf, float* scratch);
  void blend_skeleton(const float* table);
  TileRun leaf_run(std::size_t leaf, const float* table) const;
  TileRun frame_run(std::size_t leaf) const;
  void share(std::size_t slot, double* sums) const;
  void apply_to_vertices();
  void move_by_probes();
  void compute_normals();
  void finish(base::Stopwatch& watch);
  template <class Body>
  void for_leaves(const Body& body);
  template <class OfVertex>
  void add(base::AlignedVector<float>& array, const OfVertex& vector);
  template <class Vector>
  auto row_of(Vector& table, std::size_t handle) const {
    return table.begin() + static_cast<std::ptrdiff_t>(handle * columns_);
  }

  std::shared_ptr<const weights::Binding> bound_;
  std::shared_ptr<const weights::TiledBinding> binding_;
  base::WorkerPool& pool_;
  const FrameKernel& kernel_;
  const TileKernel& tiles_;  // the functions for form_
  pose::RowForm form_;
  std::size_t columns_, sums_;                    // columns_: columns of a row; sums_: sums per vertex
  std::vector<double> entries_;                   // [handle][column], lengths divided by the binding's unit
  base::AlignedVector<float> table_;              // [handle][column], entries_ minus mean_
  std::array<float, pose::most_columns> mean_{};  // [column]
  base::AlignedVector<float> rest_moments_;       // only for moment forms, see TileRun
  bool knows_rest_ = false;                       // true after rest_moments_ were computed
  base::AlignedVector<float> skeleton_sums_;      // [tile][column][lane]
  base::AlignedVector<float> skeleton_table_;     // [pivot][column]
  base::AlignedVector<float> positions_;          // slots and ghosts as x y z x, see Rings
  base::AlignedVector<pose::FrameVertex> vertices_;
  base::AlignedVector<float> shares_;    // [slot]; empty: all 1
  std::span<const Vec3> displacements_;  // displacements of the shape
  base::AlignedVector<float> offsets_;   // the binding's offsets plus the shape; empty without a shape
  base::AlignedVector<float> rest_;      // as offsets_, but from the middle of the rest cage; see fill_rest()
  std::vector<std::uint8_t> leaf_moved_;  // [leaf]: 1 if slots of the leaf moved in this frame
  std::vector<std::uint32_t> slots_;      // slot of each vertex; only filled if there are probes
  ProbeTiles probes_;
  bool dragging_ = false;
  Vec3 origin_{0, 0, 0};  // origin of the frame's rows

  struct DragCache {
    std::vector<std::uint32_t> moving;   // handles
    unsigned long resting = 0;           // CageState::resting_revision()
    std::vector<std::size_t> starts;     // leaf l has the entries [starts[l], starts[l + 1]) of listed
    std::vector<std::uint32_t> listed;   // moving handles with weights in the leaf, as indices into `moving`
    base::AlignedVector<float> sums;     // [tile][sum][lane] of the handles that do not move
    base::AlignedVector<float> weights;  // [tile][row][lane] of the moving handles
    base::AlignedVector<float> rows;     // the moving handles' rows of table_
    bool placed = false;                 // true if leaves without moving handles are up to date
    std::size_t row_count() const { return moving.size(); }
    std::size_t row_count(std::size_t leaf) const { return starts[leaf + 1] - starts[leaf]; }
  } drag_;
};

}  // namespace viete::deform
