// Makes the benchmark report in the background, in a child process.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "app/child_process.h"
#include "base/background.h"
#include "workspace/workspace.h"

namespace viete::app {

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
