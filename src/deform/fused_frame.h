// The frame at the speed of memory: logs of the cage in, positions and normals out, nothing stored in
// between.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "deform/deformer.h"
#include "deform/exact.h"
#include "deform/frame_kernel.h"
#include "deform/tiled_binding.h"

namespace viete::deform {

/// The links of Deformer's frame, method `fast`, in float: from the blend to the positions in one pass over
/// the weights, the sums staying in registers. Agrees with the staged frame to 1e-6 of the diagonal, and to
/// the binding's tolerance where that is compressed.
///
/// Dragging costs what moved: the first frame of a drag forms the sums of all elements that do not move and
/// keeps them, and from then on only the columns that move are added. Nothing accumulates. Leaves whose lists
/// have none of the elements that move are left alone.
///
/// Unless weights are compressed, vertices that the moved elements do not reach keep their bits, in a drag
/// and in full frames, as long as the pose as a whole stays about where it is (see pose_origin) and the mean
/// of its logs too.
///
/// Not thread-safe; everything that grows with the model is allocated in the constructor, or when a drag
/// begins. Results are bit-identical for any number of threads, and depend on the pose alone but for the
/// rounding of float during a drag.
class FusedFrame {
public:
  /// cage and binding must not be null and belong together.
  FusedFrame(std::shared_ptr<const Cage> cage, std::shared_ptr<const TiledBinding> binding,
             base::WorkerPool& pool, const sym3::Kernel& kernel = sym3::kernel());

  /// Tells that the poses from now on differ in the same few vertices, or that this is over.
  void set_dragging(bool on);
  /// One frame. Throws base::Error if pose.positions is not one per cage vertex.
  void deform(const Pose& pose);

  /// Of the last frame, in the file's order: positions relative to origin(), normals.
  std::span<const FrameVertex> vertices() const { return vertices_; }
  const Vec3& origin() const { return origin_; }
  /// The cage's logs; empty for mean value coordinates.
  std::span<const MapLog> logs() const { return logs_; }
  /// What the last pose gives the staged links.
  PosedHandles posed_handles() const;
  const LinkTimes& times() const { return times_; }
  const LogReport& report() const { return report_; }
  /// True if the last frame added the moved elements alone.
  bool dragging() const { return dragging_; }
  /// Bytes that the last frame read once: weights, or what stood for them.
  std::size_t bytes() const;

private:
  using Elements = std::vector<std::uint32_t>;

  void fill_table(const Pose& pose);
  void choose_mean();
  void find_moved(const Pose& pose);
  bool others_stayed() const;
  void follow_drag();
  void hold(const Elements& moving);
  std::size_t list_moving();
  void pack_listed(std::size_t leaf);
  void pack_weights(std::size_t leaf, float* scratch);
  void blend_skeleton(const float* table);
  TileRun<float> leaf_run(std::size_t leaf, const float* table) const;
  void place_vertices();
  void compute_normals();
  template <class Body>
  void for_leaves(const Body& body);

  const FrameKernel& kernel_;
  std::shared_ptr<const Cage> cage_;
  std::shared_ptr<const TiledBinding> binding_;
  base::WorkerPool& pool_;
  std::size_t columns_;
  std::vector<FaceMap> maps_;
  std::vector<MapSplit> splits_;
  std::vector<MapLog> logs_;
  Elements moved_;                                     // in this frame
  std::vector<std::array<double, log_size>> entries_;  // [handle], what table_ is made of
  base::AlignedVector<float> table_;                         // [handle][column], less the mean of its column
  std::array<float, log_size> mean_{};                 // [column]
  base::AlignedVector<float> skeleton_sums_;                 // [tile][column][lane]
  base::AlignedVector<float> skeleton_table_;                // [pivot][column]
  base::AlignedVector<float> positions_;                     // [place] of the rings, x y z x in units
  base::AlignedVector<FrameVertex> vertices_;
  std::vector<std::uint8_t> leaf_moved_;  // [leaf] its slots, in this frame
  Vec3 origin_{0, 0, 0};
  std::vector<mesh::Point> pose_;         // of the last frame
  bool drag_ = false, dragging_ = false;  // a drag is on; this frame was part of it
  LinkTimes times_;
  LogReport report_;

  /// While a few elements move: what the others amount to.
  struct Held {
    Elements moving;
    base::AlignedVector<float> table;  // when it was formed
    Vec3 origin{0, 0, 0};
    std::vector<std::size_t> starts;    // in `listed`, one more than leaves
    std::vector<std::uint32_t> listed;  // which of those that move have weight in a leaf, leaf by leaf
    base::AlignedVector<float>
        sums;  // [tile][column][lane], of the elements that do not move; of leaves that others move
    base::AlignedVector<float> weights;  // [tile][row][lane], of those that do, in the order of `listed`
    base::AlignedVector<float> rows;     // their part of the table
    bool placed = false;           // a frame was computed from these: leaves without rows stay as they are
    std::size_t row_count() const { return moving.size(); }
    std::size_t row_count(std::size_t leaf) const { return starts[leaf + 1] - starts[leaf]; }
  } held_;
};

}  // namespace viete::deform
