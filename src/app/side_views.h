// The additional views: the same document, bound and deformed separately for each.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "app/live_model.h"
#include "base/worker_pool.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

/// The model of an additional view. Shares the first view's binding if possible.
class SideModel : public ViewModel {
public:
  /// Call after a frame of the first view. Returns true if this view has a new frame too.
  bool follow(scene::View& view, scene::Workspace& workspace, const LiveModel& first, base::WorkerPool& pool,
              bool wait = false);
  /// True if follow() would do something now.
  bool is_due(const scene::View& view, const scene::Workspace& workspace, const LiveModel& first) const;
  void forget();

private:
  // Everything that determines a frame.
  struct Made {
    Need need;
    scene::Revision pose = 0;
    deform::Mask mask;
    bool other_blending = false;
    friend bool operator==(const Made&, const Made&) = default;
  };
  static Made made_of(const scene::View& view, const scene::Workspace& workspace);
  bool serves(const Need& need) const;
  bool prepare(const Need& need, const Bound& known, base::WorkerPool& pool);
  void take_binding(scene::View& view, const Need& need, base::WorkerPool& pool, bool wait);
  void install(const Need& need, base::WorkerPool& pool);

  std::optional<Made> made_;     // last frame
  Need asked_;                   // the running binding
  std::optional<Need> refused_;  // the last binding that failed
};

class SideViews {
public:
  /// See SideModel. Returns true if any view has a new frame.
  bool follow(scene::Workspace& workspace, const LiveModel& first, bool wait = false);
  void finish(scene::Workspace& workspace, const LiveModel& first);
  void forget();
  bool is_due(const scene::Workspace& workspace, const LiveModel& first) const;
  bool binding(const scene::Workspace& workspace) const;
  SideModel& operator[](std::size_t side) { return models_[side]; }
  const SideModel& operator[](std::size_t side) const { return models_[side]; }
  /// Measures the frames' errors a few times a second and stores them in the workspace. Returns true on a
  /// change.
  bool measure(scene::Workspace& workspace);

private:
  std::unique_ptr<base::WorkerPool> pool_;  // exists while there are side views
  std::array<SideModel, scene::Split::most - 1> models_;
  std::array<unsigned long, scene::Split::most - 1> measured_{};  // index of the measured frame
  double measured_at_ = -1;                                       // wall seconds
};

}  // namespace viete::app
