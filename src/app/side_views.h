// The additional views: the same document, bound and deformed separately for each.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "app/bound.h"
#include "app/live_model.h"
#include "base/background.h"
#include "base/worker_pool.h"
#include "deform/deformer.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

/// The model of one view. Shares the first view's binding if possible.
class SideModel {
public:
  /// Call after a frame of the first view. Returns true if this view has a new frame too.
  bool follow(scene::SideView& side, scene::Workspace& workspace, const LiveModel& first,
              base::WorkerPool& pool, bool wait = false);
  /// True if follow() would do something now.
  bool is_due(const scene::SideView& side, const scene::Workspace& workspace, const LiveModel& first) const;
  bool binding() const { return binder_.running(); }
  void forget();

  const deform::Deformer* deformer() const { return deformer_.get(); }
  const Bound& bound() const { return bound_; }
  unsigned long frames() const { return frames_; }

private:
  // Everything that determines the binding.
  struct Need {
    deform::Scheme scheme;
    sym3::Method method = sym3::Method::fast;
    bool staged = false;
    friend bool operator==(const Need&, const Need&) = default;
  };
  // Everything that determines a frame.
  struct Made {
    Need need;
    scene::Revision pose = 0;
    deform::Mask mask;
    bool other_blending = false;
    friend bool operator==(const Made&, const Made&) = default;
  };
  static Made made_of(const scene::SideView& side, const scene::Workspace& workspace);
  bool serves(const Need& need) const;
  bool prepare(const Need& need, const Bound& known, base::WorkerPool& pool);
  void take_binding(scene::SideView& side, const Need& need, base::WorkerPool& pool, bool wait);
  void bind_for(const Need& need, const Bound& known);
  void install(const Need& need, base::WorkerPool& pool);

  base::BackgroundJob<Bound> binder_;
  Bound bound_;
  std::unique_ptr<deform::Deformer> deformer_;
  std::optional<Made> made_;     // last frame
  Need asked_;                   // the running binding
  std::optional<Need> refused_;  // the last binding that failed
  DragFollower drag_;
  unsigned long frames_ = 0;
};

class SideViews {
public:
  /// See SideModel. Returns true if any view has a new frame.
  bool follow(scene::Workspace& workspace, const LiveModel& first);
  void finish(scene::Workspace& workspace, const LiveModel& first);
  void forget();
  bool is_due(const scene::Workspace& workspace, const LiveModel& first) const;
  bool binding(const scene::Workspace& workspace) const;
  const SideModel& operator[](std::size_t side) const { return models_[side]; }
  /// Measures the frames' errors a few times a second and stores them in the workspace. Returns true on a
  /// change.
  bool measure(scene::Workspace& workspace);
  /// True if it has a new frame since the last call.
  bool take_news(std::size_t side) { return std::exchange(news_[side], false); }

private:
  bool follow(scene::Workspace& workspace, const LiveModel& first, bool wait);

  std::unique_ptr<base::WorkerPool> pool_;  // exists while there are side views
  std::array<SideModel, scene::Split::most_sides> models_;
  std::array<bool, scene::Split::most_sides> news_{};
  std::array<unsigned long, scene::Split::most_sides> measured_{};  // index of the measured frame
  double measured_at_ = -1;                                         // wall seconds
};

}  // namespace viete::app
