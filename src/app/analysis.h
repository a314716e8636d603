// Background measurements of the open document and its frames: defects, and times and errors of the methods.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/live_model.h"
#include "app/method_timer.h"
#include "base/background.h"
#include "scene/document/checks.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

/// Restarts each measurement when its input changes, and stores the result in the workspace. Call from one
/// thread.
class Analysis {
public:
  /// probe: measure the methods. program, state: see create_and_show_report().
  Analysis(bool probe, std::filesystem::path program, std::filesystem::path state)
      : probe_wanted_(probe), program_(std::move(program)), state_(std::move(state)) {}

  /// Before the frame: handles requests and the checks.
  void follow_document(scene::Workspace& workspace);
  /// After the frame: times and errors of the methods. Whole frames are timed only while the view is at rest.
  void follow_frame(scene::Workspace& workspace, LiveModel& model, bool moves);

  /// True if follow_document() or follow_frame() would do something now.
  bool has_news(const scene::Workspace& workspace, const LiveModel& model) const;
  /// True while a computation with a displayed progress runs.
  bool reports() const { return checks_.running() || report_.running(); }
  /// True if the last call changed something visible in the workspace.
  bool shows_news() const { return shows_news_; }
  /// Measures the methods in this pose and waits for the results.
  void finish_measuring(scene::Workspace& workspace, LiveModel& model);
  bool checking() const { return checks_.running(); }
  void finish_checks(scene::Workspace& workspace);

private:
  void start_checks(const scene::Document& document);
  void take_checks(scene::Workspace& workspace, bool wait);
  void follow_report(scene::Workspace& workspace);
  void follow_path(scene::Workspace& workspace, const LiveModel& model);
  bool probe_is_due(const scene::Workspace& workspace, const LiveModel& model) const;
  void follow_probe(scene::Workspace& workspace, const LiveModel& model);
  void start_probe(scene::Workspace& workspace, const LiveModel& model);
  void take_probe(scene::Workspace& workspace, bool wait);
  bool timer_is_due(const scene::Workspace& workspace, const LiveModel& model) const;
  void start_timer(const scene::Workspace& workspace, const LiveModel& model);
  void take_times(scene::Workspace& workspace, LiveModel& model, bool wait);
  void follow_times(scene::Workspace& workspace, LiveModel& model, bool moves);

  bool probe_wanted_, shows_news_ = false;
  std::filesystem::path program_, state_;
  MethodProbe probe_;
  base::BackgroundJob<MethodTimings> timer_;
  base::BackgroundJob<std::string> report_;
  base::BackgroundJob<std::vector<scene::Finding>> checks_;
  std::shared_ptr<const mesh::Surface> checked_model_, checked_cage_;
  unsigned long probed_ = 0;  // index of the probed frame
  // Everything that determines the accuracy of a frame, except its pose.
  struct Path {
    scene::Revision surfaces = 0, cage = 0;
    deform::Scheme scheme;
    friend bool operator==(const Path&, const Path&) = default;
  };
  Path path_;
  std::optional<deform::EngineKind> engine_;
  double probed_at_ = -1;    // wall seconds
  unsigned long timed_ = 0;  // index of the frame whose pose was timed
  double rests_since_ = 0;   // wall seconds
};

}  // namespace viete::app
