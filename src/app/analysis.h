// Background measurements of the open document and its frames: defects, and times and errors of the methods.
#pragma once

#include <filesystem>
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
  /// The binding; includes staged weights if they are small enough to compute without a request.
  std::shared_ptr<const deform::Binding> binding;
};

/// Medians of interleaved frames, with its own deformer and pool. Throws base::Error if memory does not
/// suffice, and base::Cancelled between frames. Thread-safe.
MethodTimings time_methods(FrameInput timed, base::Progress& progress);

/// Times and errors of all compared methods on these matrices: medians of interleaved runs in CPU time,
/// errors against the 106-bit reference; NaN if the error of one matrix is NaN.
workspace::MethodStats measure_methods(std::span<const sym3::Sym3<double>> matrices);

/// Restarts each measurement when its input changes, and stores the result in the workspace. Call from one
/// thread.
class Analysis {
public:
  /// probe: measure the methods. program, state: see create_and_show_report().
  Analysis(bool probe, std::filesystem::path program, std::filesystem::path state)
      : probe_wanted_(probe), program_(std::move(program)), state_(std::move(state)) {}

  /// Before the frame: handles requests and the checks.
  void follow_document(workspace::Workspace& workspace);
  /// After the frame: times and errors of the methods. Whole frames are timed only while the view is at rest.
  void follow_frame(workspace::Workspace& workspace, LiveModel& model, bool moves);

  /// After the model is deformed: the data of the vertex inspector, in well under a millisecond. Returns true
  /// if they changed.
  bool follow_vertex(workspace::Workspace& workspace, const LiveModel& model);
  bool vertex_is_due(const workspace::Workspace& workspace, const LiveModel& model) const;

  /// True if follow_document() or follow_frame() would do something now.
  bool has_news(const workspace::Workspace& workspace, const LiveModel& model) const;
  /// True while a computation with a displayed progress runs.
  bool reports() const { return checks_.running() || report_.running(); }
  /// True if the last call changed something visible in the workspace.
  bool shows_news() const { return shows_news_; }
  /// Measures the methods in this pose and waits for the results.
  void finish_measuring(workspace::Workspace& workspace, LiveModel& model);
  bool checking() const { return checks_.running(); }
  void finish_checks(workspace::Workspace& workspace);

private:
  void start_checks(const document::Document& document);
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
  std::shared_ptr<const mesh::Surface> checked_model_, checked_cage_;
  unsigned long probed_ = 0;  // index of the probed frame
  // Everything that determines the accuracy of a frame, except its pose.
  struct Path {
    document::Revision surfaces = 0, cage = 0;
    deform::Scheme scheme;
    friend bool operator==(const Path&, const Path&) = default;
  };
  Path path_;
  std::optional<deform::EngineKind> engine_;
  // The frame shown by the vertex inspector.
  struct Inspected {
    std::optional<std::uint32_t> vertex;
    unsigned long frame = 0;
    const deform::Deformer* deformer = nullptr;
    friend bool operator==(const Inspected&, const Inspected&) = default;
  };
  Inspected inspected_;
  double probed_at_ = -1;    // wall seconds, of the start or the result
  unsigned long timed_ = 0;  // index of the frame whose pose was timed
  double rests_since_ = 0;   // wall seconds
};

}  // namespace viete::app
