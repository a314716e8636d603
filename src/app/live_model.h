// The open model, bound to its cage and deformed each frame, with faster frames during a drag.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/bound.h"
#include "app/file_desk.h"
#include "base/background.h"
#include "base/worker_pool.h"
#include "deform/deformer.h"
#include "deform/probe.h"
#include "mesh/adjacency.h"
#include "scene/document/document.h"
#include "scene/hand/transform_drag.h"
#include "scene/workspace/workspace.h"
#include "sym3/rotation.h"

namespace viete::app {

/// True if a drag changes the cage's rest shape: the model stays at rest.
inline bool changes_rest(const scene::Workspace& w) {
  const auto& drag = w.interaction.drag;
  return drag && w.document.kept_pose && !drag->vertices().empty();
}

class DragFollower {
public:
  using Drag = std::optional<scene::TransformDrag>;

  /// Call before a frame. True if a drag has ended or changed its vertices: the next frame must be complete.
  bool before(deform::Deformer& deformer, const Drag& drag) {
    if (!dragging_ || (drag && drag->softened() == softened_)) return false;
    deformer.end_drag();
    dragging_ = false;
    return true;
  }
  /// Call after a frame: partial frames can only follow a complete one.
  void after(deform::Deformer& deformer, const Drag& drag) {
    if (drag && !dragging_ && deformer.ran() && !drag->vertices().empty())
      deformer.begin_drag(drag->vertices());
    dragging_ = drag.has_value();
    softened_ = drag ? drag->softened() : 0;
  }

private:
  bool dragging_ = false;
  int softened_ = 0;  // soft-selection count of the current drag
};

/// Follows the document's revisions: rebinds in the background for changed surfaces or weights while the old
/// binding stays in use; pose, blend and method only need a new frame. Call from one thread.
class LiveModel {
public:
  explicit LiveModel(FileDesk& files) : files_(files) {}

  /// Changes since the last call.
  struct Changed {
    bool document = false, cage = false;
  };
  /// Call once per frame before deform(): installs a finished binding and starts a new one if needed. `made`
  /// is the binding of a newly made cage; it is ignored if it belongs to another cage.
  Changed follow(scene::Workspace& workspace, Bound made = {});
  /// Waits for the needed binding.
  void finish_binding(scene::Workspace& workspace);
  /// Cancels a running binding and reverts the setting that required it.
  void stop_binding(scene::Workspace& workspace, const std::string& why, scene::Severity severity);

  /// Deforms the model if pose, blend or method changed since the last frame, or a drag has ended. Returns
  /// true if it did. The first frame after a binding is a warm-up: it fills caches, has no meaningful timing,
  /// and is repeated.
  bool deform(scene::Workspace& workspace, scene::FrameTimes& times);

  /// True if follow() or deform() would do something now.
  bool is_due(const scene::Document& document) const;
  bool binding() const { return binder_.running(); }
  bool has_result() const { return binder_.has_result(); }
  /// True if the last frame was a warm-up.
  bool prepared() const { return prepared_; }

  /// The deformer of the open document, or null.
  const deform::Deformer* deformer() const { return deformer_.get(); }
  const Bound& bound() const { return bound_; }
  /// Replaces the binding by one of the same weights that supports more methods, for later use.
  void share(const std::shared_ptr<const deform::Binding>& binding);
  /// The number of deformed frames, to identify a measured one.
  unsigned long frames() const { return frames_; }
  /// True if the last frame computed exponentials.
  bool takes_exponentials() const {
    return deformer_ && deformer_->ran() && deformer_->scheme().exponential();
  }
  /// A vertex of the model as drawn, in the file's units.
  mesh::Point vertex(const scene::Document& document, std::size_t index) const;

private:
  void follow_surfaces(scene::Workspace& workspace, Bound bound);
  void follow_weights(const scene::Document& document);
  void start_binding(const scene::Document& document);
  void follow_path(bool same);
  void take_binding(scene::Workspace& workspace, bool wait);
  void install(scene::Workspace& workspace, Bound bound);
  void follow_mask(const scene::Document& document);
  std::shared_ptr<const deform::Cage> cage_of(const scene::Document& document);
  static deform::Scheme scheme_of(const scene::Document& document);
  void take_carried(scene::Document& document);
  scene::Carried carried_pin(const scene::Document& document, const deform::Probe& probe);
  sym3::Mat3<double> map_at(const scene::Document& document, std::uint32_t vertex) const;
  void follow_blend(const deform::Scheme& scheme);
  void make_deformer(const deform::Scheme& scheme);
  bool deforms(const scene::Document& document) const;

  FileDesk& files_;
  base::WorkerPool pool_;
  base::BackgroundJob<Bound> binder_;
  std::string binding_text_;
  std::shared_ptr<const deform::Cage> no_cage_;  // substitute for a missing cage; null until needed
  Bound bound_;                                  // input of the deformer; empty without one
  std::unique_ptr<deform::Deformer> deformer_;

  // Revisions of the last result; nullopt: derive again.
  scene::Revision surfaces_ = 0, cage_revision_ = 0, weights_ = 0;
  struct Derived {
    scene::Revision pose, method;
    friend bool operator==(const Derived&, const Derived&) = default;
  };
  std::optional<Derived> derived_;
  mesh::Adjacency around_;  // triangles at each vertex; empty until a pin needs it
  unsigned long frames_ = 0;
  bool same_path_ = false;                   // the staged engine for all methods
  std::optional<scene::Revision> given_up_;  // pose at which the first binding was cancelled
  bool unprepared_ = false, prepared_ = false;
  DragFollower drag_;
};

}  // namespace viete::app
