// Makes cages aside while a wish is being changed, so that the view stays live.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/bound.h"
#include "base/background.h"
#include "cages/make.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

/// Follows workspace.making: of each new wish a preview first, then, once the wish rests, the cage made with
/// all care. That one comes bound to the model, and so does what a preview is at once. Call from one thread.
class CageMaker {
public:
  /// Once a frame: takes what was made, unless something is being dragged, and begins what is to be made.
  void follow(scene::Workspace& workspace, bool no_drag);
  /// Gives up what is being made, and says so: the cage stays as it is until there is another wish.
  void stop(scene::Workspace& workspace);

  bool running() const { return job_.running(); }
  /// True if follow() would do something now.
  bool is_due(const scene::Workspace& workspace) const;
  /// What binds the cage that was taken last; once.
  Bound take_bound() { return std::exchange(bound_, {}); }

private:
  struct Made {
    scene::OpenedSurface surface;
    std::shared_ptr<const deform::Cage> cage;
    std::vector<std::string> notes;
    Bound bound;
  };
  // Of one model: what cages of it share is kept. Only the job's thread makes cages with it.
  struct Workshop {
    std::shared_ptr<const mesh::Surface> model;
    std::optional<cages::Maker> maker{};
  };
  void start(const scene::Workspace& workspace, cages::Effort effort);
  void take(scene::Workspace& workspace, Made&& made);
  void close(scene::Workspace& workspace);
  bool is_wished(const scene::Workspace& workspace) const { return asked_ == workspace.making.wish; }
  static Made make(Workshop& workshop, const cages::Wish& wish, const deform::Scheme& scheme,
                   sym3::Method method, base::Progress& progress);

  base::BackgroundJob<Made> job_;
  std::shared_ptr<Workshop> workshop_;
  std::string text_;
  std::optional<cages::Wish> asked_;  // the last wish that a cage was begun for
  cages::Effort effort_ = cages::Effort::preview;
  double asked_at_ = 0;  // wall seconds
  bool wants_full_ = false;
  bool is_preview_ = false;  // what was taken last, where another one was to be made with all care
  Bound bound_;
};

}  // namespace viete::app
