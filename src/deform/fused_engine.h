// The frame at the speed of memory: rows of the cage in, vertices out, nothing stored in between.
#pragma once

#include <memory>
#include <span>

#include "base/worker_pool.h"
#include "deform/engine.h"
#include "deform/frame_kernel.h"
#include "deform/probe_layer.h"
#include "deform/tiled_binding.h"

namespace viete::deform {

/// The staged chain with method `fast`, in float: from the blend to the positions in one pass over the
/// weights, the sums staying in registers. Agrees with the staged engine to 1e-6 of the diagonal, and to
/// twice the binding's tolerance where that is compressed.
///
/// Dragging costs what moved: the first frame of a drag forms the sums of all handles that do not move and
/// keeps them, and from then on only the rows that move are added. Nothing accumulates. Leaves whose lists
/// have none of the handles that move are left alone.
///
/// Unless weights are compressed, vertices that the moved handles do not reach keep their bits, in a drag
/// and in full frames, as long as the pose as a whole stays about where it is (see pose_origin) and the mean
/// of its rows too.
///
/// Results depend on the rows alone but for the rounding of float during a drag.
///
/// Maps that are fitted to points (see moments.h) take weights that are not compressed, and the first frame
/// three times as long as others: it makes what does not depend on the pose.
class FusedEngine : public Engine {
public:
  /// binding must not be null.
  FusedEngine(std::shared_ptr<const TiledBinding> binding, RowForm form, base::WorkerPool& pool,
              const sym3::Kernel& kernel = sym3::kernel());

  void set_mask(const Mask& mask) override;
  void set_shape(std::span<const Vec3> ways) override;
  /// The method does not matter.
  void run(const CageState& state, sym3::Method method = sym3::Method::fast) override;
  std::span<const FrameVertex> vertices() const override { return vertices_; }
  /// The first half of a frame: sums of the rows of every vertex, shared already, [vertex][column] in the
  /// file's order, with lengths in the file's unit. Dragging as in run().
  void blend(const CageState& state, std::span<double> sums);
  /// The second half, of other positions: vertices() are there, relative to the rows' origin, with normals.
  void show(std::span<const Vec3> positions);
  /// True if the last frame added the moved handles alone.
  bool dragging() const { return dragging_; }
  /// Bytes that the last frame read once: weights, or what stood for them.
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
  const TileKernel& tiles_;  // of the rows' form
  RowForm form_;
  std::size_t columns_, sums_;                 // of rows, and that a vertex has of them
  std::vector<double> entries_;                // [handle][column], lengths in units
  base::AlignedVector<float> table_;           // [handle][column], less the mean of its column
  std::array<float, most_columns> mean_{};     // [column]
  base::AlignedVector<float> rest_moments_;    // of forms with moments, see TileRun
  bool knows_rest_ = false;                    // these, from the first frame on
  base::AlignedVector<float> skeleton_sums_;   // [tile][column][lane]
  base::AlignedVector<float> skeleton_table_;  // [pivot][column]
  base::AlignedVector<float> positions_;       // of slots and ghosts (see Rings), x y z x in units
  base::AlignedVector<FrameVertex> vertices_;
  base::AlignedVector<float> shares_;          // [slot]; empty: all 1
  base::AlignedVector<float> rest_, offsets_;  // of a shape, as those of the binding; empty: at rest
  std::vector<std::uint8_t> leaf_moved_;       // [leaf] its slots, in this frame
  std::vector<std::uint32_t> slots_;           // of vertices, where probes are
  ProbeTiles probes_;                          // of the layer
  bool dragging_ = false;
  Vec3 origin_{0, 0, 0};  // of the frame's rows

  /// While a few handles move: the sums of the others, and the weights of those.
  struct DragCache {
    std::vector<std::uint32_t> moving;
    unsigned long resting = 0;          // revision of the others
    std::vector<std::size_t> starts;    // in `listed`, one more than leaves
    std::vector<std::uint32_t> listed;  // which of those that move have weight in a leaf, leaf by leaf
    base::AlignedVector<float> sums;  // [tile][sum][lane], of handles that do not move; of leaves others move
    base::AlignedVector<float> weights;  // [tile][row][lane], of those that do, in the order of `listed`
    base::AlignedVector<float> rows;     // their part of the table
    bool placed = false;  // a frame was computed from these: leaves without rows stay as they are
    std::size_t row_count() const { return moving.size(); }
    std::size_t row_count(std::size_t leaf) const { return starts[leaf + 1] - starts[leaf]; }
  } drag_;
};

}  // namespace viete::deform
