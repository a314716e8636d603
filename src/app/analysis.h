// Background measurements of the open document: defects of surfaces, and time and error of each method.
#pragma once

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "app/view_model.h"
#include "base/background.h"
#include "document/checks.h"
#include "workspace/workspace.h"

namespace viete::app {

struct MethodTimings {
  workspace::MethodTimes times;
  /// The timed binding. If weights of the staged engine need at most 256 MiB, time_methods() adds them.
  std::shared_ptr<const deform::Binding> binding;
};

/// Measures the time of whole frames with each method. Returns median times. Throws base::Error if memory is
/// insufficient. If cancelled, throws base::Cancelled before the next frame. Thread-safe.
MethodTimings time_methods(FrameInput timed, base::Progress& progress);

/// Measures CPU time and error of each compared method for these matrices. Times are medians. Errors are
/// relative to a reference with 106 bits. If a method gives NaN, its two errors are NaN.
workspace::MethodStats measure_methods(std::span<const sym3::Sym3<double>> matrices);

/// When to measure again after measurements on a busy computer: 2, 4, ... 64 seconds later, then no more.
struct Retry {
  double wait = 1, at = std::numeric_limits<double>::infinity();  ///< seconds; `at` is a clock time
  /// Returns the next time after a measurement. `busy` is true if other programs made its times too long.
  Retry after(bool busy, double now) const {
    return busy && wait < 64 ? Retry{2 * wait, now + 2 * wait} : Retry{busy ? wait : 1};
  }
};

/// Measures again when the input of a measurement changes. Stores results in the workspace. Not thread-safe.
class Analysis {
public:
  /// If `probe` is true, measures the methods. See create_and_show_report() for `program` and `state`.
  Analysis(bool probe, std::filesystem::path program, std::filesystem::path state)
      : probe_wanted_(probe), program_(std::move(program)), state_(std::move(state)) {}

  /// Call before each frame. Starts requested reports, and checks of new surfaces. Stores finished results.
  void follow_document(workspace::Workspace& workspace);
  /// Call after each frame. Measures times and errors. `moves` must be true if this frame shows motion.
  void follow_frame(workspace::Workspace& workspace, LiveModel& model, bool moves);

  /// If the inspected vertex or the frame has changed, updates the vertex inspector and returns true.
  bool follow_vertex(workspace::Workspace& workspace, const LiveModel& model);
  bool vertex_is_due(const workspace::Workspace& workspace, const LiveModel& model) const;

  /// True if a result is ready or a measurement is due.
  bool has_news(const workspace::Workspace& workspace, const LiveModel& model) const;
  /// True while checks or a report run. Both show a progress bar.
  bool reports() const { return checks_.running() || report_.running(); }
  /// True if the last follow_document() or follow_frame() changed something visible in the workspace.
  bool shows_news() const { return shows_news_; }
  /// Measures the methods in this pose and waits for the results.
  void finish_measuring(workspace::Workspace& workspace, LiveModel& model);
  bool checking() const { return checks_.running(); }
  void finish_checks(workspace::Workspace& workspace);

private:
  void start_checks(const document::Document& document);
  void follow_outside(workspace::Workspace& workspace);
  void take_checks(workspace::Workspace& workspace, bool wait);
  void follow_report(workspace::Workspace& workspace);
  void follow_path(workspace::Workspace& workspace, const LiveModel& model);
  bool probe_is_due(const workspace::Workspace& workspace, const LiveModel& model) const;
  void start_probe(workspace::Workspace& workspace, const LiveModel& model);
  void take_probe(workspace::Workspace& workspace, bool wait);
  bool timer_is_due(const workspace::Workspace& workspace, const LiveModel& model) const;
  void start_timer(const workspace::Workspace& workspace, const LiveModel& model);
  void take_times(workspace::Workspace& workspace, LiveModel& model, bool wait);
  void follow_times(workspace::Workspace& workspace, LiveModel& model, bool moves);

  bool probe_wanted_, shows_news_ = false;
  std::filesystem::path program_, state_;
  base::BackgroundJob<workspace::MethodStats> probe_;
  base::BackgroundJob<MethodTimings> timer_;
  base::BackgroundJob<std::string> report_;
  base::BackgroundJob<std::vector<document::Finding>> checks_;
  std::shared_ptr<const mesh::Surface> checked_model_, checked_cage_, outside_of_;
  unsigned long probed_ = 0;  // index of the last frame sampled by start_probe()
  // If one of these members changes, measurements are discarded.
  struct Path {
    document::Revision surfaces = 0, cage = 0;
    deform::Scheme scheme;
    friend bool operator==(const Path&, const Path&) = default;
  };
  Path path_;
  std::optional<deform::EngineKind> engine_;
  // The vertex and the frame shown by the vertex inspector.
  struct Inspected {
    std::optional<std::uint32_t> vertex;
    unsigned long frame = 0;
    const deform::Deformer* deformer = nullptr;
    friend bool operator==(const Inspected&, const Inspected&) = default;
  };
  Inspected inspected_;
  double probed_at_ = -1;    // when probe_ was last started or gave a result, in wall seconds
  unsigned long timed_ = 0;  // index of the frame whose pose was last timed
  double rests_since_ = 0;   // time of the last motion, in wall seconds
  Retry retry_;              // of times of the pose timed_
};

}  // namespace viete::app
