// The deformed model of each view. Binding runs in the background; each frame deforms the model.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "base/background.h"
#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/frame_deformer.h"
#include "deform/stitching.h"
#include "document/document.h"
#include "mesh/adjacency.h"
#include "mesh/drawing.h"
#include "pose/probe.h"
#include "sym3/rotation.h"
#include "weights/binding.h"
#include "workspace/workspace.h"

namespace viete::app {

/// A model and a cage to bind.
struct Pair {
  std::shared_ptr<const mesh::Surface> model;
  std::shared_ptr<const pose::Cage> cage;
  std::shared_ptr<const mesh::Splats> splats{};  ///< of a capture; null for other models
};

/// A model bound to a cage: the input of a FrameDeformer.
struct Bound : Pair {
  std::shared_ptr<const weights::Binding> binding;
  std::shared_ptr<const deform::Stitching> stitching{};  ///< null until a stitched deformer is bound
  std::shared_ptr<const weights::Binding> draft{};       ///< binding of the model's draft, or null

  bool stitches(const pose::Deformer& deformer) const { return stitching && stitching->serves(deformer); }
  /// True if this is a binding of the document's model to the document's cage, with any weights.
  bool binds(const document::Document& document) const {
    return binding && model == document.model().surface && cage == document.cage();
  }
};

/// Binds the model for the engines of this deformer and method. Reuses parts of `known` with the same input.
/// Also binds the draft if there is one. Throws base::Error if memory is insufficient, base::Cancelled if
/// cancelled. Thread-safe.
Bound bind(const Pair& pair, const pose::Deformer& deformer, sym3::Method method, const Bound& known,
           base::Progress& progress, const std::shared_ptr<const mesh::Draft>& draft = nullptr);

/// True if a drag changes the cage's rest shape. During this drag, the model does not change.
inline bool changes_rest(const workspace::Workspace& w) {
  const auto& drag = w.view.interaction.drag;
  return drag && w.document.kept_pose() && !drag->vertices().empty();
}

/// Passes the beginning and end of drags to a FrameDeformer, so that frames during a drag are faster.
class DragFollower {
public:
  using Drag = std::optional<interact::TransformDrag>;

  /// Call before a frame. Returns true if a drag has ended, or if the drag now moves other vertices. If true,
  /// the next frame must be computed completely.
  bool before(deform::FrameDeformer& deformer, const Drag& drag) {
    if (!dragging_ || (drag && drag->softened() == softened_)) return false;
    deformer.end_drag();
    dragging_ = false;
    return true;
  }
  /// Call after a frame. Begins a drag in the FrameDeformer if it has computed a frame.
  void after(deform::FrameDeformer& deformer, const Drag& drag) {
    if (drag && !dragging_ && deformer.ran() && !drag->vertices().empty())
      deformer.begin_drag(drag->vertices());
    dragging_ = drag.has_value();
    softened_ = drag ? drag->softened() : 0;
  }

private:
  bool dragging_ = false;
  int softened_ = 0;  // TransformDrag::softened() of the current drag
};

/// A copy of a frame's input, for background work.
struct FrameInput {
  Bound bound;
  pose::Deformer deformer;
  sym3::Method method = sym3::Method::fast;
  pose::Pose pose;
  weights::Mask mask;
  pose::Probes probes;
  weights::SharedShape shape;
};

/// The FrameDeformer of one view, with its binding. Not thread-safe.
class ViewModel {
public:
  explicit ViewModel(base::Wake wake = nullptr) : binder_(std::move(wake)) {}
  bool binding() const { return binder_.running(); }
  bool has_result() const { return binder_.has_result(); }
  /// May be null.
  const deform::FrameDeformer* deformer() const { return deformer_.get(); }
  const Bound& bound() const { return bound_; }
  /// True if the deformer has computed a frame.
  bool ran() const { return deformer_ && deformer_->ran(); }
  /// The input of a frame with this method. deformer() must not be null.
  FrameInput input(const document::Document& document, sym3::Method method) const {
    return {bound_,
            deformer_->deformer(),
            method,
            document.has_cage() ? document.pose() : pose::rest_pose(*bound_.cage),
            deformer_->mask(),
            document.probes(),
            document.shape()};
  }
  /// The number of frames computed so far. Measurements identify a frame by this number.
  unsigned long frames() const { return frames_; }
  /// True if a frame was computed since the last call.
  bool take_news() { return std::exchange(news_, false); }

protected:
  // The input of a binding.
  struct Need {
    pose::Deformer deformer;
    sym3::Method method = sym3::Method::fast;
    friend bool operator==(const Need&, const Need&) = default;
  };
  void bind_for(const Need& need, const Pair& pair, const Bound& known, std::string name = "",
                std::shared_ptr<const mesh::Draft> draft = nullptr) {
    binder_.start(
        [=](base::Progress& progress) {
          return app::bind(pair, need.deformer, need.method, known, progress, draft);
        },
        std::move(name));
  }
  void make_deformer(const pose::Deformer& deformer, base::WorkerPool& pool) {
    deformer_ = std::make_unique<deform::FrameDeformer>(
        bound_.cage, bound_.binding, deformer, pool, bound_.stitches(deformer) ? bound_.stitching : nullptr);
    deformer_->set_splats(bound_.splats);
    drag_ = {};
  }
  void deform_pose(const document::Document& document, const pose::Pose& pose,
                   const weights::SharedShape& shape, sym3::Method method) {
    if (deformer_->mask() != document.mask()) deformer_->set_mask(document.mask());
    deformer_->set_probes(document.probes());
    deformer_->set_shape(shape);
    deformer_->deform(document.has_cage() ? pose : pose::rest_pose(*bound_.cage), method);
    ++frames_;
    news_ = true;
  }

  base::BackgroundJob<Bound> binder_;
  Bound bound_;  // the deformer's binding; empty if deformer_ is null
  std::unique_ptr<deform::FrameDeformer> deformer_;
  DragFollower drag_;

private:
  unsigned long frames_ = 0;
  bool news_ = false;
};

/// The model of the first view. If the surfaces change, stays at rest until the new binding is ready. If the
/// weights change, uses the old binding until the new binding is ready. Not thread-safe.
class LiveModel : public ViewModel {
public:
  explicit LiveModel(base::Wake wake = nullptr) : ViewModel(std::move(wake)) {}
  ~LiveModel() {
    deformer_.reset();
    draft_.reset();
  }

  struct Changed {
    bool document = false, cage = false;
  };
  /// Call once per frame, before deform(). Installs a finished binding. If needed, starts a new binding.
  /// `known` is the binding of opened files or of a generated cage. If the document has other surfaces,
  /// ignores `known`. `draft` is the draft of the document's model, or null. Returns the changes since the
  /// last call.
  Changed follow(workspace::Workspace& workspace, const std::shared_ptr<const mesh::Draft>& draft = nullptr,
                 Bound known = {});
  /// Waits for the running binding.
  void finish_binding(workspace::Workspace& workspace) { take_binding(workspace, true); }
  /// Cancels a running binding, reverts the settings that required this binding, and shows the message `why`.
  void stop_binding(workspace::Workspace& workspace, const std::string& why, workspace::Severity severity);

  /// If the pose, blend, method or mask has changed, or a drag has ended, deforms the model and returns true.
  /// The first frame after a binding fills caches, so the times of this frame are not representative. The
  /// next call repeats this frame.
  bool deform(workspace::Workspace& workspace, workspace::FrameTimes& times);
  /// Works like deform(), but if possible deforms only the draft. Then deformer() keeps the last frame of the
  /// model, and the next deform() is due.
  bool deform_draft(workspace::Workspace& workspace, workspace::FrameTimes& times);
  /// The deformer of the draft if the draft was deformed since the last call, otherwise null.
  const deform::FrameDeformer* take_draft() {
    return std::exchange(draft_news_, false) ? draft_.get() : nullptr;
  }

  /// True if the draft shows the current pose, but the model does not.
  bool shows_draft(const document::Document& document) const;
  /// True if follow() would do something now.
  bool binding_is_due(const document::Document& document) const;
  /// True if deform_draft() would deform something now.
  bool frame_is_due(const document::Document& document) const {
    return deforms(document) && !shows_draft(document);
  }
  /// True if the last frame was the first frame after a binding.
  bool prepared() const { return prepared_; }

  /// If `binding` is the current binding plus weights for the staged engine, later deformers use `binding`.
  void share(const std::shared_ptr<const weights::Binding>& binding);
  /// True if the last frame computed exponentials.
  bool takes_exponentials() const { return ran() && deformer_->deformer().exponential(); }
  /// The position of a vertex of the drawn model, in the file's units.
  mesh::Point vertex(const document::Document& document, std::size_t index) const;

private:
  void follow_surfaces(workspace::Workspace& workspace, Bound bound);
  void start_binding(const document::Document& document);
  void take_binding(workspace::Workspace& workspace, bool wait);
  void install(workspace::Workspace& workspace, Bound bound);
  std::shared_ptr<const pose::Cage> cage_of(const document::Document& document);
  std::shared_ptr<const mesh::Draft> draft_of(const document::Document& document);
  static pose::Deformer deformer_of(const document::Document& document);
  void take_carried(document::Document& document);
  document::Carried carried_pin(const document::Document& document, const pose::Probe& probe);
  sym3::Mat3<double> map_at(const document::Document& document, std::uint32_t vertex) const;
  void follow_blend(const pose::Deformer& deformer);
  void renew_deformer(const pose::Deformer& deformer);
  bool deforms(const document::Document& document) const;

  base::WorkerPool pool_;
  std::shared_ptr<const mesh::Draft> model_draft_;  // the draft of the document's model, or null
  std::shared_ptr<const pose::Cage> no_cage_;       // substitute for a missing cage; null until needed
  document::Revision surfaces_ = 0, cage_revision_ = 0, weights_ = 0;  // revisions of the last follow()
  struct Derived {
    document::Revision pose, method;
    weights::Mask mask;
    friend bool operator==(const Derived&, const Derived&) = default;
  };
  static Derived derived_of(const document::Document& document) {
    return {document.revisions().pose, document.revisions().method, document.mask()};
  }
  // The input of the last frame, and of the draft. If nullopt, the next deform() computes a frame.
  std::optional<Derived> derived_, drafted_;
  std::unique_ptr<deform::FrameDeformer> draft_;  // null without a draft
  bool draft_news_ = false;
  std::shared_ptr<const weights::Binding> undrafted_;  // binding whose draft was given up
  mesh::Adjacency around_;                      // triangles at each vertex; empty until a pin needs them
  std::optional<document::Revision> given_up_;  // revision of the pose when the first binding was cancelled
  bool unprepared_ = false, prepared_ = false;
};

/// The model of an additional view. Uses the first view's binding if possible.
class SideModel : public ViewModel {
public:
  using ViewModel::ViewModel;

  /// Call after a frame of the first view. Returns true if this view has a new frame.
  bool follow(workspace::SplitView& view, workspace::Workspace& workspace, const LiveModel& first,
              base::WorkerPool& pool, bool wait = false);
  /// True if follow() would do something now.
  bool is_due(const workspace::SplitView& view, const workspace::Workspace& workspace,
              const LiveModel& first) const;
  void forget();

private:
  // The input of a frame.
  struct Made {
    Need need;
    document::Revision pose = 0;
    weights::Mask mask;
    bool other_blending = false;
    friend bool operator==(const Made&, const Made&) = default;
  };
  static Made made_of(const workspace::SplitView& view, const workspace::Workspace& workspace);
  bool serves(const Need& need) const;
  bool lacks(const Made& wanted, const LiveModel& first) const;

  std::optional<Made> made_;     // input of the last frame
  Need asked_;                   // input of the running binding
  std::optional<Need> refused_;  // input of the last binding that failed
};

class SideModels {
public:
  explicit SideModels(const base::Wake& wake = nullptr)
      : models_{SideModel(wake), SideModel(wake), SideModel(wake)} {}

  /// Call after a frame of the first view. Returns true if any view has a new frame.
  bool follow(workspace::Workspace& workspace, const LiveModel& first, bool wait = false);
  void finish(workspace::Workspace& workspace, const LiveModel& first);
  void forget();
  bool is_due(const workspace::Workspace& workspace, const LiveModel& first) const;
  bool binding(const workspace::Workspace& workspace) const;
  SideModel& operator[](std::size_t side) { return models_[side]; }
  const SideModel& operator[](std::size_t side) const { return models_[side]; }
  /// Measures the errors of the frames a few times a second and stores them in the workspace. Returns true if
  /// errors were measured.
  bool measure(workspace::Workspace& workspace);
  /// The seconds until measure() has something to do; base::never without further frames.
  double measuring_in(const workspace::Workspace& workspace) const;

private:
  bool lacks_error(std::size_t side) const;

  std::unique_ptr<base::WorkerPool> pool_;  // exists while there are side views
  std::array<SideModel, workspace::Split::most - 1> models_;
  std::array<unsigned long, workspace::Split::most - 1> measured_{};  // number of the last measured frame
  double measured_at_ = -1;  // time of the last measurement, in wall seconds
};

}  // namespace viete::app
