// Measures time and error of each method in the background, on the matrices of the current pose.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "app/view_model.h"
#include "base/background.h"
#include "base/clock.h"
#include "workspace/workspace.h"

namespace viete::app {

struct MethodTimings {
  workspace::MethodTimes times;
  /// The timed binding. If weights of the staged engine need at most 256 MiB, time_methods() adds them.
  std::shared_ptr<const weights::Binding> binding;
};

/// Measures the time of whole frames with each method. Returns median times. Throws base::Error if memory is
/// insufficient. If cancelled, throws base::Cancelled before the next frame. Thread-safe.
MethodTimings time_methods(FrameInput timed, base::Progress& progress);

/// Measures CPU time and error of each compared method for these matrices. Times are medians. Errors are
/// relative to a reference with 106 bits. If a method gives NaN, its two errors are NaN.
workspace::MethodStats measure_methods(std::span<const sym3::Sym3<double>> matrices);

/// When to measure again after measurements on a busy computer: 2, 4, ... 64 seconds later, then no more.
struct Retry {
  double wait = 1, at = base::never;  ///< seconds; `at` is a clock time
  /// Returns the next time after a measurement. `busy` is true if other programs made its times too long.
  Retry after(bool busy, double now) const {
    return busy && wait < 64 ? Retry{2 * wait, now + 2 * wait} : Retry{busy ? wait : 1};
  }
};

/// Measures again when the input of a measurement changes. Stores results in the workspace. Not thread-safe.
class MethodMeasuring {
public:
  /// If `wanted` is false, measures nothing.
  explicit MethodMeasuring(bool wanted, const base::Wake& wake = nullptr)
      : wanted_(wanted), sampler_(wake), timer_(wake) {}

  /// Call after each frame. `moves` must be true if this frame shows motion. Returns true if something
  /// visible has changed in the workspace.
  bool follow(workspace::Workspace& workspace, LiveModel& model, bool moves);
  /// The seconds until follow() has something to do; infinity without further frames.
  double due_in(const workspace::Workspace& workspace, const LiveModel& model) const;
  /// Measures the methods in this pose and waits for the results.
  void finish(workspace::Workspace& workspace, LiveModel& model);

private:
  // If one of these members changes, measurements are discarded.
  struct Key {
    document::Revision surfaces = 0, cage = 0;
    pose::Deformer deformer;
    friend bool operator==(const Key&, const Key&) = default;
  };
  static Key key_of(const workspace::Workspace& workspace, const LiveModel& model);
  bool discard_old(workspace::Workspace& workspace, const LiveModel& model);
  double sampling_in(const workspace::Workspace& workspace, const LiveModel& model) const;
  bool start_sampling(workspace::Workspace& workspace, const LiveModel& model);
  bool take_samples(workspace::Workspace& workspace, bool wait);
  double timing_in(const workspace::Workspace& workspace, const LiveModel& model) const;
  void start_timing(const workspace::Workspace& workspace, const LiveModel& model);
  bool take_times(workspace::Workspace& workspace, LiveModel& model, bool wait);
  void show_drawn_times(workspace::Workspace& workspace, const LiveModel& model) const;

  bool wanted_;
  base::BackgroundJob<workspace::MethodStats> sampler_;
  base::BackgroundJob<MethodTimings> timer_;
  Key key_;
  std::optional<pose::EngineKind> engine_;
  unsigned long sampled_ = 0;  // number of the last frame sampled by start_sampling()
  double sampled_at_ = -1;     // when sampler_ was last started or gave a result, in wall seconds
  unsigned long timed_ = 0;    // number of the frame whose pose was last timed
  double rests_since_ = 0;     // time of the last motion, in wall seconds
  Retry retry_;                // of times of the pose timed_
};

}  // namespace viete::app
