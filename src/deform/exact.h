// Computes the deformed model in double precision, for files. Works block by block to save memory.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/bind.h"
#include "deform/cage_state.h"
#include "deform/probe.h"
#include "deform/probe_layer.h"
#include "deform/shape_follower.h"
#include "deform/stitching.h"
#include "deform/surface_proxy.h"
#include "deform/weigher.h"
#include "sym3/exp.h"

namespace viete::deform {

struct ExactModel {
  std::vector<mesh::Point> positions;  ///< one per vertex
  LogReport report;                    ///< as CageState::report()
  std::vector<std::string> warnings;   ///< as Binding::warnings
  double exp_error = 0;                ///< largest error of an exponential, see place_vertices()
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

  /// model and pool must outlive the deformer; cage must not be null. progress reports the work before the
  /// first pose, and may be null. Throws base::Error if the model has no vertices, and base::Cancelled.
  ExactDeformer(const mesh::Surface& model, std::shared_ptr<const Cage> cage, const Scheme& scheme,
                sym3::Method method, base::WorkerPool& pool, Weights weights, const Mask& mask = nullptr,
                base::Progress* progress = nullptr);
  ExactDeformer(const ExactDeformer&) = delete;
  ExactDeformer& operator=(const ExactDeformer&) = delete;

  /// Deforms `shape` (null: the rest model) by the cage, and then by the probes, see ProbeLayer. Throws
  /// base::Error if the pose does not have one position per cage vertex, and base::Cancelled.
  ExactModel deform(const Pose& pose, const Probes& probes = {}, const SharedShape& shape = nullptr,
                    base::Progress* progress = nullptr);

private:
  BoundPart part(std::size_t begin, std::size_t count) const;
  std::vector<Vec3> ways(const Binding& part, const SharedShape& shape, std::size_t begin) const;
  double place(const Binding& part, const SharedShape& shape, std::size_t begin,
               std::span<mesh::Point> positions);
  void stitch_positions(std::span<const Vec3> ways, std::span<mesh::Point> positions) const;

  const mesh::Surface& model_;
  std::shared_ptr<const Cage> cage_;
  Scheme scheme_;
  sym3::Method method_;
  base::WorkerPool& pool_;
  Mask mask_;
  CageState state_;
  Weigher weigher_;
  std::optional<Stitching> stitching_;
  std::optional<CoarseModel> coarse_model_;  // stitched instead of the model, by coarse_
  std::unique_ptr<ExactDeformer> coarse_;
  std::vector<double> sums_;           // weighted sums of rows for all vertices, only for stitching
  Shares shares_;                      // shares of all vertices, only for stitching
  Binding surface_weights_;            // weights along the surface of a small model; empty for other weights
  std::optional<ProxyWeights> proxy_;  // weights along the surface of a large model
  KnownRow row_;                       // reads surface_weights_ or proxy_; empty for other weights
  std::vector<BoundPart> parts_;       // one per block; empty unless weights are kept
  ProbeLayer layer_;
  std::optional<ShapeFollower> follower_;  // rotates shapes if the elements only translate
};

ExactModel deform_exactly(const mesh::Surface& model, std::shared_ptr<const Cage> cage, const Scheme& scheme,
                          const Pose& pose, sym3::Method method, base::WorkerPool& pool,
                          base::Progress* progress = nullptr, const Mask& mask = nullptr,
                          const Probes& probes = {}, const SharedShape& shape = nullptr);

}  // namespace viete::deform
