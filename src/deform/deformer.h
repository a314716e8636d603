// One frame: a pose becomes rows, and an engine turns them into vertices.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "deform/binding.h"
#include "deform/cage_state.h"
#include "deform/fused_engine.h"
#include "deform/shape_follower.h"
#include "deform/staged_engine.h"
#include "deform/stitched_engine.h"
#include "deform/weigher.h"

namespace viete::deform {

/// One bound model with the engines that its binding and method allow. Method `fast`, and schemes without an
/// exponential, use the fused engine if the binding has tiles; stitched schemes use the stitched engine with
/// any method. Cage and binding are shared and constant, so a new binding can be made on another thread while
/// this one is in use. Not thread-safe.
class Deformer {
public:
  /// cage and binding must not be null and must belong together; the binding's weights must be those of the
  /// scheme. stitching must be for the scheme's elements; null if the scheme is not stitched, or until it is
  /// ready.
  Deformer(std::shared_ptr<const Cage> cage, std::shared_ptr<const Binding> binding, const Scheme& scheme,
           base::WorkerPool& pool, std::shared_ptr<const Stitching> stitching = nullptr);

  const Scheme& scheme() const { return scheme_; }
  /// Sets the amounts of the next frames; the rest of the scheme stays.
  void set_amounts(const Amounts& amounts);
  /// Sets the mask of the next frames: one factor per vertex, 0 (rests) to 1 (follows fully); null: all 1.
  void set_mask(Mask mask);
  const Mask& mask() const { return mask_; }
  /// The shape that the cage deforms in the next frames. Must fit the model; null: at rest.
  void set_shape(const SharedShape& shape);
  const SharedShape& shape() const { return shape_; }
  /// Sets the probes of the next frames, a layer applied after the cage.
  void set_probes(const Probes& probes);
  const ProbeLayer& probes() const { return layer_; }
  const Binding& binding() const { return *binding_; }
  /// True: the next frames use only the staged engine if the blend takes exponentials, so that all methods
  /// are compared on the same path.
  void set_all_staged(bool all) { all_staged_ = all; }
  bool all_staged() const { return all_staged_; }
  /// The engine that runs the method; nullopt if the binding does not support it, or if the scheme is
  /// stitched and stitching is missing.
  std::optional<EngineKind> engine(sym3::Method method) const;
  /// Until end_drag(), poses must differ from the last one in these cage vertices only; the cost of the fused
  /// engine's frames is then proportional to the number of moved handles.
  void begin_drag(std::span<const std::uint32_t> vertices) { state_.begin_drag(vertices); }
  void end_drag() { state_.end_drag(); }
  /// Computes one frame. Throws base::Error unless pose.positions has one entry per cage vertex. If
  /// engine(method) is nullopt, falls back to the fused engine, which must exist.
  void deform(const Pose& pose, sym3::Method method);

  /// Vertices of the last frame, in the file's order, relative to origin(); empty before the first frame.
  std::span<const FrameVertex> vertices() const;
  Vec3 origin() const { return state_.rows().origin; }
  const CageState& state() const { return state_; }
  /// The engine of the last frame; nullopt before the first frame.
  std::optional<EngineKind> ran() const { return ran_; }
  LinkTimes times() const;

  /// Copies of all positions and normals of the last frame. Double precision for the staged engine, and for
  /// positions of the stitched engine unless probes move them; rounded as FrameVertex for the fused engine.
  std::vector<mesh::Point> positions() const;
  std::vector<mesh::Point> normals() const;
  /// The matrices that the last frame exponentiated, for at most `limit` vertices spread evenly over the
  /// model, recomputed from exact weights; empty if it took no exponentials. One or two microseconds each.
  std::vector<sym3::Sym3<double>> sample_matrices(std::size_t limit) const;
  /// See deform::sampled_error(); 0 after a staged frame. For a stitched frame: the error of the blended
  /// vertices, before stitching and probes, which use double precision.
  double sampled_error() const;

private:
  Engine& of(EngineKind kind) const;
  template <class Act>
  void for_engines(const Act& act);
  void show_ways(std::span<const Vec3> ways);
  const Engine& last() const { return of(*ran_); }
  void carry_probes();

  std::shared_ptr<const Cage> cage_;
  base::WorkerPool& pool_;
  std::shared_ptr<const Binding> binding_;
  Scheme scheme_;
  Mask mask_;
  SharedShape shape_;
  std::vector<Vec3> ways_;                   // displacements of the shape from rest
  std::span<const Vec3> shown_ways_;         // the engines' displacements: ways_, or rotated
  std::unique_ptr<ShapeFollower> follower_;  // null: not needed
  CageState state_;
  Weigher weigher_;
  ProbeLayer layer_;
  std::unique_ptr<FusedEngine> fused_;
  std::unique_ptr<StagedEngine> staged_;
  std::unique_ptr<StitchedEngine> stitched_;
  std::optional<EngineKind> ran_;
  bool all_staged_ = false;
};

}  // namespace viete::deform
