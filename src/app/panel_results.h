// Results for panels: checks of the surfaces and the benchmark report, made in the background, and the vertex
// inspector.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/child_process.h"
#include "app/view_model.h"
#include "base/background.h"
#include "document/checks.h"
#include "workspace/workspace.h"

namespace viete::app {

/// Checks model and cage again when a surface changes. Stores findings in the workspace. Not thread-safe.
class SurfaceChecks {
public:
  explicit SurfaceChecks(base::Wake wake = nullptr) : job_(std::move(wake)) {}

  /// Starts checks of new surfaces. Stores finished results; returns true if there were any.
  bool follow(workspace::Workspace& workspace);
  /// True if follow() would do something now.
  bool is_due(const workspace::Workspace& workspace) const {
    return job_.has_result() || checked_ != surfaces_of(workspace);
  }
  bool running() const { return job_.running(); }
  void finish(workspace::Workspace& workspace);

private:
  struct Surfaces {
    std::shared_ptr<const mesh::Surface> model, cage;
    friend bool operator==(const Surfaces&, const Surfaces&) = default;
  };
  static Surfaces surfaces_of(const workspace::Workspace& w) {
    return {w.document.model().surface, w.document.cage_file().surface};
  }
  bool take(workspace::Workspace& workspace, bool wait);
  void follow_outside(workspace::Workspace& workspace);

  base::BackgroundJob<std::vector<document::Finding>> job_;
  Surfaces checked_;
  std::shared_ptr<const mesh::Surface> outside_of_;  // the model of CheckState::outside
};

/// Updates View::vertex. Not thread-safe.
class VertexInspector {
public:
  /// If the inspected vertex or the frame of the model has changed, updates the view and returns true.
  bool follow(workspace::Workspace& workspace, const LiveModel& model);
  /// True if follow() would do something now.
  bool is_due(const workspace::Workspace& w, const LiveModel& model) const {
    return (w.view.vertex.vertex || shown_.vertex) && shown_ != key_of(w, model);
  }

private:
  struct Key {
    std::optional<std::uint32_t> vertex;
    unsigned long frame = 0;
    const deform::FrameDeformer* deformer = nullptr;
    friend bool operator==(const Key&, const Key&) = default;
  };
  static Key key_of(const workspace::Workspace& w, const LiveModel& model) {
    return {w.view.vertex.vertex, model.frames(), model.deformer()};
  }

  Key shown_;
};

/// Not thread-safe.
class ReportMaker {
public:
  /// See create_and_show_report() for `program` and `state`.
  ReportMaker(std::filesystem::path program, std::filesystem::path state, base::Wake wake = nullptr)
      : program_(std::move(program)), state_(std::move(state)), job_(std::move(wake)) {}

  void start() {
    job_.start([program = program_, state = state_](base::Progress& progress) {
      return create_and_show_report(program, state, progress);
    });
  }
  void cancel() { job_.cancel(); }
  bool running() const { return job_.running(); }
  /// True if follow() would do something now.
  bool is_due() const { return job_.has_result(); }
  /// Reports a finished report in the workspace. Returns true if there was one.
  bool follow(workspace::Workspace& w) {
    const auto result = job_.poll();
    w.jobs.reporting = job_.state();
    if (!result) return false;
    if (result->value) {
      w.messages.succeeded("report");
      w.messages.info(*result->value);
    }
    if (!result->problem.empty()) w.messages.error("Report failed: " + result->problem, {"report"});
    return true;
  }

private:
  std::filesystem::path program_, state_;
  base::BackgroundJob<std::string> job_;
};

}  // namespace viete::app
