// Generates cages in the background while the settings change, so that the view stays responsive.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/view_model.h"
#include "base/background.h"
#include "cages/capture.h"
#include "cages/make.h"
#include "workspace/workspace.h"

namespace viete::app {

/// If the settings in workspace.making change, generates a preview. If the settings then stay unchanged,
/// generates the cage in full quality and binds the model. For a box, the preview is final. Not thread-safe.
class CageMaker {
public:
  explicit CageMaker(base::Wake wake = nullptr) : job_(std::move(wake)) {}

  /// Call once per frame. If `no_drag` is true, puts a finished cage into the document and starts the next
  /// generation. If the panel is closed, cancels the generation. Returns true if a generation has ended.
  bool follow(workspace::Workspace& workspace, bool no_drag);
  /// Cancels the generation and shows a message. The current cage stays until the settings change.
  void stop(workspace::Workspace& workspace);

  bool running() const { return job_.running(); }
  /// The seconds until follow() has something to do; base::never without further input.
  double due_in(const workspace::Workspace& workspace, bool no_drag) const;
  /// Moves the binding of the last finished cage to the caller. The binding of a preview is empty.
  Bound take_bound() { return std::exchange(bound_, {}); }

private:
  struct Made {
    document::OpenedSurface surface;
    std::shared_ptr<const pose::Cage> cage;
    std::vector<std::string> notes;
    Bound bound;
  };
  // The input and the caches for all cages of one model. Only the job's thread changes the caches.
  struct Workshop {
    std::shared_ptr<const mesh::Surface> model;
    std::shared_ptr<const mesh::Splats> splats;
    std::optional<cages::Maker> maker{};
    std::string note{};  // about splats that the cage ignores
  };
  void start(const workspace::Workspace& workspace, cages::Effort effort);
  void take(workspace::Workspace& workspace, Made&& made);
  void close(workspace::Workspace& workspace);
  bool is_wished(const workspace::Workspace& workspace) const { return asked_ == workspace.making.wish; }
  static Made make(Workshop& workshop, const cages::Wish& wish, const pose::Deformer& deformer,
                   sym3::Method method, base::Progress& progress);

  base::BackgroundJob<Made> job_;
  std::shared_ptr<Workshop> workshop_;
  std::optional<cages::Wish> asked_;  // the settings of the last job
  cages::Effort effort_ = cages::Effort::preview;
  double asked_at_ = 0;  // time of the last change of the settings, in wall seconds
  bool wants_full_ = false;
  bool is_preview_ = false;  // true: the last finished cage is not of full quality
  Bound bound_;
};

}  // namespace viete::app
