// Computes one frame: from a pose to rows, and from rows to vertices.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "deform/fused_engine.h"
#include "deform/shape_follower.h"
#include "deform/splats.h"
#include "deform/staged_engine.h"
#include "deform/stitched_engine.h"
#include "pose/cage_state.h"
#include "weights/binding.h"
#include "weights/weigher.h"

namespace viete::deform {

/// A bound model with the engines that its binding allows. Stitched deformers use the stitched engine. Method
/// `fast` and deformers without exponentials use the fused engine if the binding has tiles. Otherwise, the
/// staged engine is used. Not thread-safe. Other threads can read the constant cage and binding.
class FrameDeformer {
public:
  /// `cage` and `binding` must not be null, and the binding must be for this cage and the deformer's weights.
  /// `stitching` must be for this deformer, or null if the deformer is not stitched or stitching is not
  /// ready.
  FrameDeformer(std::shared_ptr<const pose::Cage> cage, std::shared_ptr<const weights::Binding> binding,
                const pose::Deformer& deformer, base::WorkerPool& pool,
                std::shared_ptr<const Stitching> stitching = nullptr);

  const pose::Deformer& deformer() const { return deformer_; }
  /// Changes only the amounts of the deformer. All setters apply to the next frames.
  void set_amounts(const pose::Amounts& amounts);
  /// mask: one factor per vertex, from 0 (stays at rest) to 1 (full motion); null if all are 1.
  void set_mask(weights::Mask mask);
  const weights::Mask& mask() const { return mask_; }
  /// Sets the shape that the cage deforms: one position per vertex, or null for the rest positions.
  void set_shape(const weights::SharedShape& shape);
  const weights::SharedShape& shape() const { return shape_; }
  /// Sets the probes, which move the model after the cage.
  void set_probes(const pose::Probes& probes);
  const ProbeLayer& probes() const { return layer_; }
  const weights::Binding& binding() const { return *binding_; }
  /// Sets the splats of a capture; null for none. The binding must have tips, see Binding::tip_step.
  void set_splats(std::shared_ptr<const mesh::Splats> splats);
  /// The splats of the last frame; nullopt if the model is not a capture.
  const std::optional<SplatFrame>& splats() const { return splats_; }
  /// If `all`, blends with exponentials use the staged engine even with method `fast`, to compare times.
  void set_all_staged(bool all) { all_staged_ = all; }
  /// Returns the engine for the method, or nullopt if the engine's binding or stitching is missing.
  std::optional<pose::EngineKind> engine(sym3::Method method) const;
  /// See CageState::begin_drag() and FusedEngine.
  void begin_drag(std::span<const std::uint32_t> vertices) { state_.begin_drag(vertices); }
  void end_drag() { state_.end_drag(); }
  /// Computes one frame. Throws base::Error if pose.positions does not have one entry per cage vertex. If
  /// engine(method) is nullopt, uses the fused engine, which must then exist.
  void deform(const pose::Pose& pose, sym3::Method method);

  /// Vertices of the last frame without tips, in the file's order, relative to origin(); empty before the
  /// first frame.
  std::span<const pose::FrameVertex> vertices() const;
  Vec3 origin() const { return state_.rows().origin; }
  const pose::CageState& state() const { return state_; }
  /// The engine of the last frame; nullopt before the first frame.
  std::optional<pose::EngineKind> ran() const { return ran_; }
  pose::StageTimes times() const;
  /// Returns FusedEngine::bytes() of the last frame, which must be fused.
  std::size_t fused_bytes() const { return fused_ ? fused_->bytes() : 0; }

  /// Return copies of all positions and normals of the last frame. The staged engine gives double precision,
  /// other engines the precision of FrameVertex. Stitched positions are double if no probe moves the model.
  std::vector<mesh::Point> positions() const;
  std::vector<mesh::Point> normals() const;
  /// Returns the logs of stretch of the last frame at up to `limit` vertices, spread evenly over the model.
  /// Empty if the blend has no exponentials. Computes exact weights in one or two microseconds per vertex.
  std::vector<sym3::Sym3<double>> sample_matrices(std::size_t limit) const;
  /// Returns deform::sampled_error() of the last frame; 0 after a staged frame. After a stitched frame,
  /// measures the blended vertices before stitching and probes.
  double sampled_error() const;

private:
  Engine& of(pose::EngineKind kind) const;
  template <class Act>
  void for_engines(const Act& act);
  void show_displacements(std::span<const Vec3> displacements);
  const Engine& last() const { return of(*ran_); }

  std::shared_ptr<const pose::Cage> cage_;
  base::WorkerPool& pool_;
  std::shared_ptr<const weights::Binding> binding_;
  pose::Deformer deformer_;
  weights::Mask mask_, all_mask_;  // all_mask_: with tips
  weights::SharedShape shape_;
  std::vector<Vec3> displacements_;  // displacements of the shape from rest
  std::span<const Vec3>
      shown_displacements_;  // displacements passed to the engines: displacements_ or rotated displacements_
  std::unique_ptr<ShapeFollower> follower_;  // rotates displacements_; null if not needed
  pose::CageState state_;
  weights::Weigher weigher_;
  ProbeLayer layer_;
  std::optional<SplatFrame> splats_;
  double splats_ms_ = 0;
  std::unique_ptr<FusedEngine> fused_;
  std::unique_ptr<StagedEngine> staged_;
  std::unique_ptr<StitchedEngine> stitched_;
  std::optional<pose::EngineKind> ran_;
  bool all_staged_ = false;
};

}  // namespace viete::deform
