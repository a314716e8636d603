// The frame at memory bandwidth: cage rows in, vertices out, no intermediate arrays.
#pragma once

#include <memory>
#include <span>

#include "base/worker_pool.h"
#include "deform/engine.h"
#include "deform/frame_kernel.h"
#include "deform/probe_layer.h"
#include "deform/tiled_binding.h"

namespace viete::deform {

/// The staged chain with method `fast`, in float: one pass over the weights from the blend to the positions,
/// with the sums in registers. Agrees with the staged engine to 1e-6 of the diagonal, and to twice the
/// binding's tolerance if that is compressed.
///
/// The cost of a drag is proportional to the number of moved handles: the first frame of a drag stores the
/// sums of all other handles, and later frames only add the rows that move. Errors do not accumulate. Leaves
/// whose lists contain no moved handle are skipped.
///
/// Unless weights are compressed, vertices outside the reach of the moved handles keep their bits, in a drag
/// and in full frames, while the origin of the pose (see pose_origin) and the mean of its rows stay.
///
/// Results depend only on the rows, except for float rounding during a drag.
///
/// Maps that are fitted to points (see moments.h) need uncompressed weights. Their first frame takes three
/// times as long as later ones: it precomputes all data that does not depend on the pose.
class FusedEngine : public Engine {
public:
  /// binding must not be null.
  FusedEngine(std::shared_ptr<const TiledBinding> binding, RowForm form, base::WorkerPool& pool,
              const sym3::Kernel& kernel = sym3::kernel());

  void set_mask(const Mask& mask) override;
  void set_shape(std::span<const Vec3> ways) override;
  /// Ignores the method: always `fast`.
  void run(const CageState& state, sym3::Method method = sym3::Method::fast) override;
  std::span<const FrameVertex> vertices() const override { return vertices_; }
  /// First half of a frame: sums of rows with shares applied, [vertex][column] in the file's order, lengths
  /// in the file's unit. Dragging as in run().
  void blend(const CageState& state, std::span<double> sums);
  /// Second half with other positions: vertices() take these, relative to the rows' origin, and get normals.
  void show(std::span<const Vec3> positions);
  /// True if the last frame added the moved handles alone.
  bool dragging() const { return dragging_; }
  /// Bytes of weights or factors that the last frame read.
  std::size_t bytes() const;

private:
  using Handles = std::span<const std::uint32_t>;

  const base::AlignedVector<float>& rest() const { return rest_.empty() ? binding_->rest : rest_; }
  const base::AlignedVector<float>& offsets() const {
    return offsets_.empty() ? binding_->offsets : offsets_;
  }
  void prepare(const CageState& state);
  void fill_table(const Rows& rows);
  void fill_rest_moments(const Rows& rows);
  void fill_rest_moments(std::size_t leaf, double unit);
  void choose_mean();
  void follow_drag(const CageState& state);
  void begin_drag(Handles moving);
  std::size_t list_moving();
  void pack_whole(std::size_t leaf);
  void pack_weights(std::size_t leaf, float* scratch);
  void blend_skeleton(const float* table);
  TileRun<float> leaf_run(std::size_t leaf, const float* table) const;
  TileRun<float> frame_run(std::size_t leaf) const;
  void share(std::size_t slot, double* sums) const;
  void place_vertices();
  void move_by_probes();
  void compute_normals();
  template <class Body>
  void for_leaves(const Body& body);
  template <class Vector>
  auto row_of(Vector& table, std::size_t handle) const {
    return table.begin() + static_cast<std::ptrdiff_t>(handle * columns_);
  }

  std::shared_ptr<const TiledBinding> binding_;
  base::WorkerPool& pool_;
  const FrameKernel& kernel_;
  const TileKernel& tiles_;  // for the rows' form
  RowForm form_;
  std::size_t columns_, sums_;                 // columns of a row, and sums per vertex
  std::vector<double> entries_;                // [handle][column], lengths in units
  base::AlignedVector<float> table_;           // [handle][column], less the mean of its column
  std::array<float, most_columns> mean_{};     // [column]
  base::AlignedVector<float> rest_moments_;    // for forms with moments, see TileRun
  bool knows_rest_ = false;                    // rest_moments_ are computed, by the first frame
  base::AlignedVector<float> skeleton_sums_;   // [tile][column][lane]
  base::AlignedVector<float> skeleton_table_;  // [pivot][column]
  base::AlignedVector<float> positions_;       // slots and ghosts (see Rings), x y z x in units
  base::AlignedVector<FrameVertex> vertices_;
  base::AlignedVector<float> shares_;          // [slot]; empty: all 1
  base::AlignedVector<float> rest_, offsets_;  // the shape, laid out as in the binding; empty: at rest
  std::vector<std::uint8_t> leaf_moved_;       // [leaf] true if its slots moved in this frame
  std::vector<std::uint32_t> slots_;           // slot of each vertex, if there are probes
  ProbeTiles probes_;                          // tiles of the layer
  bool dragging_ = false;
  Vec3 origin_{0, 0, 0};  // origin of the frame's rows

  /// During a drag: the sums of the resting handles, and the weights of the moving ones.
  struct DragCache {
    std::vector<std::uint32_t> moving;
    unsigned long resting = 0;           // revision of the resting handles
    std::vector<std::size_t> starts;     // in `listed`, one more than leaves
    std::vector<std::uint32_t> listed;   // moving handles with weight in a leaf, leaf by leaf
    base::AlignedVector<float> sums;     // [tile][sum][lane] of resting handles, for leaves to update
    base::AlignedVector<float> weights;  // [tile][sum][lane] of resting handles, for leaves in reach
    base::AlignedVector<float> rows;     // the moving handles' rows of the table
    bool placed = false;                 // a frame used this cache: leaves without rows are up to date
    std::size_t row_count() const { return moving.size(); }
    std::size_t row_count(std::size_t leaf) const { return starts[leaf + 1] - starts[leaf]; }
  } drag_;
};

}  // namespace viete::deform
