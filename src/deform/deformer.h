// The frame, top to bottom: a pose becomes rows, an engine makes vertices of them.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "deform/binding.h"
#include "deform/cage_state.h"
#include "deform/fused_engine.h"
#include "deform/staged_engine.h"
#include "deform/stitched_engine.h"
#include "deform/way_turner.h"
#include "deform/weigher.h"

namespace viete::deform {

/// One bound model, and the engines that its binding and the method allow: method `fast`, and schemes without
/// an exponential, take the fused one where the binding has tiles; stitched schemes take the stitched one
/// with any method. Cage and binding are shared and constant, so that a new binding can be made elsewhere
/// while this one is in use. Not thread-safe.
class Deformer {
public:
  /// cage and binding must not be null and belong together, the binding's weights being those of the scheme.
  /// stitching, of the scheme's elements, is for stitched schemes: null where there is none (yet).
  Deformer(std::shared_ptr<const Cage> cage, std::shared_ptr<const Binding> binding, const Scheme& scheme,
           base::WorkerPool& pool, std::shared_ptr<const Stitching> stitching = nullptr);

  const Scheme& scheme() const { return scheme_; }
  /// Of the next frames; all else of the scheme stays.
  void set_amounts(const Amounts& amounts);
  /// Of the next frames; null: every vertex follows. One share a vertex, 0 to 1.
  void set_mask(Mask mask);
  const Mask& mask() const { return mask_; }
  /// Of the next frames: what the cage acts upon. Of the same model, or null: at rest.
  void set_shape(const SharedShape& shape);
  const SharedShape& shape() const { return shape_; }
  /// Of the next frames: a layer upon what the cage does.
  void set_probes(const Probes& probes);
  const ProbeLayer& probes() const { return layer_; }
  const Binding& binding() const { return *binding_; }
  /// Of the next frames: with the staged engine alone, where the blend takes exponentials, so that all
  /// methods are compared on the same path.
  void set_all_staged(bool all) { all_staged_ = all; }
  bool all_staged() const { return all_staged_; }
  /// The engine that runs the method; nothing if the binding is not for it, or the scheme is stitched and
  /// there is no stitching.
  std::optional<EngineKind> engine(sym3::Method method) const;
  /// From now on poses differ from the last one in these vertices of the cage alone: frames of the fused
  /// engine then cost what moves.
  void begin_drag(std::span<const std::uint32_t> vertices) { state_.begin_drag(vertices); }
  void end_drag() { state_.end_drag(); }
  /// One frame. Throws base::Error if pose.positions is not one per cage vertex. Where engine(method) is
  /// nothing, the fused engine's, which must be there: what it blends stands in for what is asked for.
  void deform(const Pose& pose, sym3::Method method);

  /// Of the last frame, in the file's order, relative to origin(); empty before the first one.
  std::span<const FrameVertex> vertices() const;
  Vec3 origin() const { return state_.rows().origin; }
  const CageState& state() const { return state_; }
  /// The engine of the last frame; nothing before the first one.
  std::optional<EngineKind> ran() const { return ran_; }
  LinkTimes times() const;

  /// Copies of all positions and normals of the last frame: of the staged engine in double, positions of the
  /// stitched one too where no probe moves them, of the fused one as it left them.
  std::vector<mesh::Point> positions() const;
  std::vector<mesh::Point> normals() const;
  /// The matrices that the last frame exponentiated, of at most `limit` vertices spread evenly over the
  /// model, formed anew from exact weights; empty if it took no exponentials. A microsecond or two each.
  std::vector<sym3::Sym3<double>> sample_matrices(std::size_t limit) const;
  /// See deform::sampled_error(); 0 after a staged frame. Of a stitched one that of the blended vertices
  /// which it follows, before they are stitched and moved by probes: all that comes then is in double.
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
  std::vector<Vec3> ways_;             // of the shape, from rest
  std::span<const Vec3> shown_ways_;   // as the engines have them: these, or turned
  std::unique_ptr<WayTurner> turner_;  // null: not needed
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
