// The frame at the speed of memory: logs of the cage in, positions and normals out, nothing stored in between.
#pragma once

#include <memory>
#include <span>

#include "deform/deformer.h"
#include "deform/frame_kernel.h"
#include "deform/tiled_binding.h"

namespace viete::deform {

/// The links of Deformer's frame, method `fast`, in float: from the blend to the positions in one pass over the
/// weights, the sums staying in registers. Agrees with the staged frame to 1e-6 of the diagonal. Not
/// thread-safe; everything that grows with the model is allocated in the constructor. Results are bit-identical
/// for any number of threads.
class FusedFrame {
public:
  /// cage and binding must not be null and belong together.
  FusedFrame(std::shared_ptr<const Cage> cage, std::shared_ptr<const TiledBinding> binding,
             base::WorkerPool& pool, const sym3::Kernel& kernel = sym3::kernel());

  /// One frame. Throws base::Error if pose.positions is not one per cage vertex.
  void deform(const Pose& pose);

  /// Of the last frame, in the file's order: positions relative to origin(), normals.
  std::span<const FrameVertex> vertices() const { return vertices_; }
  const Vec3& origin() const { return origin_; }
  const LinkTimes& times() const { return times_; }
  const LogReport& report() const { return report_; }

private:
  void log_cage(const Pose& pose);
  void fill_table();
  void place_vertices();
  void compute_normals();
  template <class Body>
  void for_leaves(const Body& body);

  const FrameKernel& kernel_;
  std::shared_ptr<const Cage> cage_;
  std::shared_ptr<const TiledBinding> binding_;
  base::WorkerPool& pool_;
  std::vector<FaceMap> maps_;
  std::vector<MapLog> logs_;
  AlignedVector<float> table_;      // [handle][column]
  AlignedVector<float> positions_;  // [place] of the rings, x y z x in units
  std::vector<FrameVertex> vertices_;
  Vec3 origin_{0, 0, 0};
  LinkTimes times_;
  LogReport report_;
};

}  // namespace viete::deform
