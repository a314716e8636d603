// The model of one view: bound in the background, deformed each frame, faster during a drag.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/bound.h"
#include "base/background.h"
#include "base/worker_pool.h"
#include "deform/deformer.h"
#include "scene/workspace/workspace.h"

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

/// A snapshot of a frame's input, for background work.
struct FrameInput {
  Bound bound;
  deform::Scheme scheme;
  sym3::Method method = sym3::Method::fast;
  bool all_staged = false;  ///< the staged engine for all methods
  deform::Pose pose;
  deform::Mask mask;
  deform::Probes probes;
  deform::SharedShape shape;
};

/// Call from one thread. A pool passed to it must outlive the deformer.
class ViewModel {
public:
  bool binding() const { return binder_.running(); }
  bool has_result() const { return binder_.has_result(); }
  /// The deformer of the open document, or null.
  const deform::Deformer* deformer() const { return deformer_.get(); }
  const Bound& bound() const { return bound_; }
  /// True once the model has been deformed with its deformer.
  bool ran() const { return deformer_ && deformer_->ran(); }
  /// The input of a frame with this method; there must be a deformer.
  FrameInput input(const scene::Document& document, sym3::Method method) const {
    return {bound_,
            deformer_->scheme(),
            method,
            deformer_->all_staged(),
            document.has_cage() ? document.pose : deform::rest_pose(*bound_.cage),
            deformer_->mask(),
            document.probes,
            document.shape};
  }
  /// The number of deformed frames, to identify a measured one.
  unsigned long frames() const { return frames_; }
  /// True if there is a new frame since the last call.
  bool take_news() { return std::exchange(news_, false); }

protected:
  // Everything that determines the binding.
  struct Need {
    deform::Scheme scheme;
    sym3::Method method = sym3::Method::fast;
    bool staged = false;  // the staged engine for all methods
    friend bool operator==(const Need&, const Need&) = default;
  };
  void bind_for(const Need& need, std::shared_ptr<const mesh::Surface> model,
                std::shared_ptr<const deform::Cage> cage, const Bound& known, std::string name = "") {
    // Every method except `fast` uses the staged weights.
    const sym3::Method method = need.staged ? sym3::Method::diag : need.method;
    binder_.start(
        [=, scheme = need.scheme](base::Progress& progress) {
          return app::bind(model, cage, scheme, method, known, progress);
        },
        std::move(name));
  }
  void make_deformer(const deform::Scheme& scheme, bool staged, base::WorkerPool& pool) {
    deformer_ = std::make_unique<deform::Deformer>(bound_.cage, bound_.binding, scheme, pool,
                                                   bound_.stitches(scheme) ? bound_.stitching : nullptr);
    deformer_->set_all_staged(staged);
    drag_ = {};
  }
  void run(const scene::Document& document, const deform::Pose& pose, const deform::SharedShape& shape,
           sym3::Method method) {
    if (deformer_->mask() != document.mask) deformer_->set_mask(document.mask);
    deformer_->set_probes(document.probes);
    deformer_->set_shape(shape);
    deformer_->deform(document.has_cage() ? pose : deform::rest_pose(*bound_.cage), method);
    ++frames_;
    news_ = true;
  }

  base::BackgroundJob<Bound> binder_;
  Bound bound_;  // input of the deformer; empty without one
  std::unique_ptr<deform::Deformer> deformer_;
  DragFollower drag_;

private:
  unsigned long frames_ = 0;
  bool news_ = false;
};

}  // namespace viete::app
