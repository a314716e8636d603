// The open model, bound to its cage and deformed, and frames that follow a drag.
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

/// The hand changes the cage itself: models stay as they are at rest.
inline bool changes_rest(const scene::Workspace& w) {
  const auto& drag = w.interaction.drag;
  return drag && w.document.kept_pose && !drag->vertices().empty();
}

class DragFollower {
public:
  using Drag = std::optional<scene::TransformDrag>;

  /// Before a frame. True where a drag has ended, or moves others than it did: the next frame must be whole.
  bool before(deform::Deformer& deformer, const Drag& drag) {
    if (!dragging_ || (drag && drag->softened() == softened_)) return false;
    deformer.end_drag();
    dragging_ = false;
    return true;
  }
  /// After it: from the next frame on only what was deformed whole can be followed in parts.
  void after(deform::Deformer& deformer, const Drag& drag) {
    if (drag && !dragging_ && deformer.ran() && !drag->vertices().empty())
      deformer.begin_drag(drag->vertices());
    dragging_ = drag.has_value();
    softened_ = drag ? drag->softened() : 0;
  }

private:
  bool dragging_ = false;
  int softened_ = 0;  // of the drag that is followed
};

/// Follows the document's revisions: surfaces and weights are bound aside, while what was bound before
/// serves; pose, blend and method are a frame. Call from one thread.
class LiveModel {
public:
  explicit LiveModel(FileDesk& files) : files_(files) {}

  /// What is another one than at the last call.
  struct Changed {
    bool document = false, cage = false;
  };
  /// Once a frame, before deform(): takes what was bound, and begins what must be bound. `made` may bind
  /// another cage of the document.
  Changed follow(scene::Workspace& workspace, Bound made = {});
  /// Waits until what must be bound is.
  void finish_binding(scene::Workspace& workspace);
  /// What asked for a binding is given up, if one is being made: the document is again as it is bound.
  void stop_binding(scene::Workspace& workspace, const std::string& why, scene::Severity severity);

  /// Deforms the model if the pose, the blend or the method is another one than in the last frame, or a drag
  /// has ended. Says whether it did. The first frame after a binding is only a preparation: it fills caches,
  /// says nothing of the frames to come, and is due again.
  bool deform(scene::Workspace& workspace, scene::FrameTimes& times);

  /// True if follow() or deform() would do something now.
  bool is_due(const scene::Document& document) const;
  bool binding() const { return binder_.running(); }
  bool has_result() const { return binder_.has_result(); }
  /// True if the last frame was such a preparation.
  bool prepared() const { return prepared_; }

  /// Of the open document; null while there is none.
  const deform::Deformer* deformer() const { return deformer_.get(); }
  const Bound& bound() const { return bound_; }
  /// A binding of the same weights that can serve more methods: the next choice of one finds it made.
  void share(const std::shared_ptr<const deform::Binding>& binding);
  /// Frames that were deformed so far: whoever measures one remembers which.
  unsigned long frames() const { return frames_; }
  /// The last one took exponentials.
  bool takes_exponentials() const {
    return deformer_ && deformer_->ran() && deformer_->scheme().exponential();
  }
  /// A vertex of the model as it is drawn, in the file's units.
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
  std::shared_ptr<const deform::Cage> no_cage_;  // where there is none; null until it is asked for
  Bound bound_;                                  // what the deformer is made of; nothing while there is none
  std::unique_ptr<deform::Deformer> deformer_;

  // What was derived last; nothing: it is to be derived anew.
  scene::Revision surfaces_ = 0, cage_revision_ = 0, weights_ = 0;
  struct Derived {
    scene::Revision pose, method;
    friend bool operator==(const Derived&, const Derived&) = default;
  };
  std::optional<Derived> derived_;
  mesh::Adjacency around_;  // triangles of vertices; empty until a pin asks
  unsigned long frames_ = 0;
  bool same_path_ = false;                   // the staged engine for all methods
  std::optional<scene::Revision> given_up_;  // pose at which the first binding was stopped
  bool unprepared_ = false, prepared_ = false;
  DragFollower drag_;
};

}  // namespace viete::app
