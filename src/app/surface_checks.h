// Checks the surfaces of the open document in the background.
#pragma once

#include <memory>
#include <utility>
#include <vector>

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

}  // namespace viete::app
