// The open model, bound to its cage and deformed each frame, with faster frames during a drag.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/bound.h"
#include "app/file_desk.h"
#include "app/view_model.h"
#include "base/worker_pool.h"
#include "deform/probe.h"
#include "mesh/adjacency.h"
#include "scene/document/document.h"
#include "scene/workspace/workspace.h"
#include "sym3/rotation.h"

namespace viete::app {

/// Follows the document's revisions: rebinds in the background for changed surfaces or weights while the old
/// binding stays in use; pose, blend and method only need a new frame. Call from one thread.
class LiveModel : public ViewModel {
public:
  explicit LiveModel(FileDesk& files) : files_(files) {}
  ~LiveModel() { deformer_.reset(); }

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
  /// True if the last frame was a warm-up.
  bool prepared() const { return prepared_; }

  /// Replaces the binding by one of the same weights that supports more methods, for later use.
  void share(const std::shared_ptr<const deform::Binding>& binding);
  /// True if the last frame computed exponentials.
  bool takes_exponentials() const { return ran() && deformer_->scheme().exponential(); }
  /// A vertex of the model as drawn, in the file's units.
  mesh::Point vertex(const scene::Document& document, std::size_t index) const;

private:
  void follow_surfaces(scene::Workspace& workspace, Bound bound);
  void follow_weights(const scene::Document& document);
  void start_binding(const scene::Document& document);
  void follow_path(bool same);
  void take_binding(scene::Workspace& workspace, bool wait);
  void install(scene::Workspace& workspace, Bound bound);
  std::shared_ptr<const deform::Cage> cage_of(const scene::Document& document);
  static deform::Scheme scheme_of(const scene::Document& document);
  void take_carried(scene::Document& document);
  scene::Carried carried_pin(const scene::Document& document, const deform::Probe& probe);
  sym3::Mat3<double> map_at(const scene::Document& document, std::uint32_t vertex) const;
  void follow_blend(const deform::Scheme& scheme);
  void renew_deformer(const deform::Scheme& scheme);
  bool deforms(const scene::Document& document) const;

  FileDesk& files_;
  base::WorkerPool pool_;
  std::shared_ptr<const deform::Cage> no_cage_;  // substitute for a missing cage; null until needed

  // Revisions of the last result; nullopt: derive again.
  scene::Revision surfaces_ = 0, cage_revision_ = 0, weights_ = 0;
  struct Derived {
    scene::Revision pose, method;
    deform::Mask mask;
    friend bool operator==(const Derived&, const Derived&) = default;
  };
  static Derived derived_of(const scene::Document& document) {
    return {document.revisions().pose, document.revisions().method, document.mask};
  }
  std::optional<Derived> derived_;
  mesh::Adjacency around_;                   // triangles at each vertex; empty until a pin needs it
  bool same_path_ = false;                   // the staged engine for all methods
  std::optional<scene::Revision> given_up_;  // pose at which the first binding was cancelled
  bool unprepared_ = false, prepared_ = false;
};

}  // namespace viete::app
