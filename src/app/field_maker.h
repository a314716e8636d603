// The field that the window shows: computed in the frame where that is quick, else aside.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "app/live_model.h"
#include "base/background.h"
#include "base/worker_pool.h"
#include "lab/field.h"
#include "lab/strain.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

/// Follows the frames of a model while a field of it is shown, and costs nothing otherwise. Call from one
/// thread.
class FieldMaker {
public:
  /// After a frame is deformed: the newest values go into the workspace, and the next ones are begun. Those
  /// that are computed aside may be of a pose a moment ago. Says whether there are new ones.
  bool follow(scene::Workspace& workspace, const LiveModel& model) { return follow(workspace, model, false); }
  /// Waits until the values are those of this pose.
  void finish(scene::Workspace& workspace, const LiveModel& model);
  /// Another document: what was begun about the old one is void.
  void forget();
  /// True if follow() would do something now.
  bool has_news(const scene::Workspace& workspace, const LiveModel& model) const;

private:
  // What values are of.
  struct Subject {
    lab::Field field = lab::Field::none;
    unsigned long frame = 0;
    bool deformed = true;
    scene::Selection selection;  // of influence
    friend bool operator==(const Subject&, const Subject&) = default;
  };
  static Subject subject_of(const scene::Workspace& workspace, const LiveModel& model);
  bool is_due(const scene::Workspace& workspace, const LiveModel& model) const;
  bool follow(scene::Workspace& workspace, const LiveModel& model, bool wait);
  void begin(const scene::Workspace& workspace, const LiveModel& model);
  void take(scene::Workspace& workspace, lab::FieldValues&& values);
  std::shared_ptr<const lab::Strain> strain_of(const scene::Document& document);

  std::unique_ptr<base::WorkerPool> pool_;
  std::shared_ptr<const mesh::Surface> surface_;
  std::shared_ptr<const lab::Strain> strain_;  // of that surface
  base::BackgroundJob<lab::FieldValues> job_;
  Subject subject_;
};

}  // namespace viete::app
