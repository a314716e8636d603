// Computes the deformed model in double precision, for files. Works block by block to save memory.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/probe_layer.h"
#include "deform/shape_follower.h"
#include "deform/splats.h"
#include "deform/stitching.h"
#include "pose/cage_state.h"
#include "pose/probe.h"
#include "sym3/exp.h"
#include "weights/bind.h"
#include "weights/surface_proxy.h"
#include "weights/weigher.h"

namespace viete::deform {

using mesh::Vec3;

struct ExactModel {
  std::vector<mesh::Point> positions;            ///< one per vertex
  pose::LogReport report;                        ///< as CageState::report()
  std::vector<std::string> warnings;             ///< as Binding::warnings
  double exp_error = 0;                          ///< largest error of an exponential, see apply_to_vertices()
  std::shared_ptr<const mesh::Splats> splats{};  ///< the posed splats of a capture; null for other models
};

/// Deforms one model by any number of poses. The positions differ from those of the staged engine by at most
/// 1e-12 of the cage's diagonal. The number of threads and earlier poses do not change the results. Needs
/// memory for the positions and about a megabyte per thread (more if the cage has over 10,000 elements).
/// Weights along the surface also need memory: for all vertices of a small model, for the clusters of the
/// proxy of a large one. Not thread-safe.
class ExactDeformer {
public:
  /// Weights::kept keeps all weights for later poses, if they need less than a quarter of the free memory.
  enum class Weights { dropped, kept };

  /// model and pool must outlive this object; cage must not be null. progress reports the work before the
  /// first pose, and may be null. `splats` are those of a capture, or null. Throws base::Error if the model
  /// has no vertices, and base::Cancelled.
  ExactDeformer(const mesh::Surface& model, std::shared_ptr<const pose::Cage> cage,
                const pose::Deformer& deformer, sym3::Method method, base::WorkerPool& pool, Weights weights,
                const weights::Mask& mask = nullptr, base::Progress* progress = nullptr,
                std::shared_ptr<const mesh::Splats> splats = nullptr);
  ExactDeformer(const ExactDeformer&) = delete;
  ExactDeformer& operator=(const ExactDeformer&) = delete;

  /// Deforms `shape` (null: the rest model) by the cage, and then by the probes, see ProbeLayer. Throws
  /// base::Error if the pose does not have one position per cage vertex, and base::Cancelled.
  ExactModel deform(const pose::Pose& pose, const pose::Probes& probes = {},
                    const weights::SharedShape& shape = nullptr, base::Progress* progress = nullptr);

private:
  weights::BoundPart part(std::size_t begin, std::size_t count) const;
  std::vector<Vec3> displacements(const weights::Binding& part, const weights::SharedShape& shape,
                                  std::size_t begin) const;
  double place(const weights::Binding& part, const weights::SharedShape& shape, std::size_t begin,
               std::span<mesh::Point> positions);
  void stitch_positions(std::span<const Vec3> displacements, std::span<mesh::Point> positions) const;

  void pose_splats(ExactModel& exact) const;

  std::shared_ptr<const mesh::Splats> splats_;  // null if the model is not a capture
  double tip_step_ = 0;                         // 0 without splats
  mesh::Surface with_tips_;                     // empty without splats
  const mesh::Surface& model_;
  std::shared_ptr<const pose::Cage> cage_;
  pose::Deformer deformer_;
  sym3::Method method_;
  base::WorkerPool& pool_;
  weights::Mask mask_;
  pose::CageState state_;
  weights::Weigher weigher_;
  std::optional<Stitching> stitching_;
  std::optional<weights::CoarseModel> coarse_model_;  // stitched instead of the model, by coarse_
  std::unique_ptr<ExactDeformer> coarse_;
  std::vector<double> sums_;          // weighted sums of rows for all vertices, only for stitching
  weights::Shares shares_;            // shares of all vertices, only for stitching
  std::vector<mesh::Point> blended_;  // positions before stitching, only for stitching
  weights::Binding surface_weights_;  // weights along the surface of a small model; empty for other weights
  std::optional<weights::ProxyWeights> proxy_;  // weights along the surface of a large model
  weights::KnownRow row_;                       // reads surface_weights_ or proxy_; empty for other weights
  std::vector<weights::BoundPart> parts_;       // one per block; empty unless weights are kept
  ProbeLayer layer_;
  std::optional<ShapeFollower> follower_;  // rotates shapes if the elements only translate
};

ExactModel deform_exactly(const mesh::Surface& model, std::shared_ptr<const pose::Cage> cage,
                          const pose::Deformer& deformer, const pose::Pose& pose, sym3::Method method,
                          base::WorkerPool& pool, base::Progress* progress = nullptr,
                          const weights::Mask& mask = nullptr, const pose::Probes& probes = {},
                          const weights::SharedShape& shape = nullptr,
                          std::shared_ptr<const mesh::Splats> splats = nullptr);

}  // namespace viete::deform
