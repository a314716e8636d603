// The views beside the first one: the same document, bound and deformed once more for each.
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

/// One of them. What the first view is bound by is shared where it serves here too.
class SideModel {
public:
  /// After a frame of the first view. Says whether this one has another frame, too.
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
  // What decides how it is bound.
  struct Need {
    deform::Scheme scheme;
    sym3::Method method = sym3::Method::fast;
    bool staged = false;
    friend bool operator==(const Need&, const Need&) = default;
  };
  // What a frame is of.
  struct Made {
    Need need;
    scene::Revision pose = 0;
    deform::Mask mask;
    bool other_lines = false;
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
  std::optional<Made> made_;     // of the last frame
  Need asked_;                   // what is being bound
  std::optional<Need> refused_;  // what could not be
  DragFollower drag_;
  unsigned long frames_ = 0;
};

class SideViews {
public:
  /// See SideModel. Says whether any has another frame.
  bool follow(scene::Workspace& workspace, const LiveModel& first);
  void finish(scene::Workspace& workspace, const LiveModel& first);
  void forget();
  bool is_due(const scene::Workspace& workspace, const LiveModel& first) const;
  bool binding(const scene::Workspace& workspace) const;
  const SideModel& operator[](std::size_t side) const { return models_[side]; }
  /// Errors of the frames, a few times a second: into the workspace. Says whether there are others.
  bool measure(scene::Workspace& workspace);
  /// Has another frame since the last call.
  bool take_news(std::size_t side) { return std::exchange(news_[side], false); }

private:
  bool follow(scene::Workspace& workspace, const LiveModel& first, bool wait);

  std::unique_ptr<base::WorkerPool> pool_;  // while there are any
  std::array<SideModel, scene::Split::most_sides> models_;
  std::array<bool, scene::Split::most_sides> news_{};
  std::array<unsigned long, scene::Split::most_sides> measured_{};  // which frame
  double measured_at_ = -1;                                         // wall seconds
};

}  // namespace viete::app
