#include "app/first_motion.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "base/error.h"
#include "deform/pose_io.h"
#include "scene/document/edit.h"
#include "scene/workspace/saving.h"

namespace viete::app {

void FirstMotion::step(scene::Workspace& workspace, bool ready, double seconds_passed) {
  if (!moving()) {
    if (!file_.empty() && ready && begin(workspace)) place(workspace, 0);
    return;
  }
  passed_ += seconds_passed;
  const double t = std::min(passed_ / seconds, 1.0);
  place(workspace, t * t * (3 - 2 * t));
  if (t == 1) goal_.reset();
}

void FirstMotion::finish(scene::Workspace& workspace) {
  file_.clear();
  if (!moving()) return;
  place(workspace, 1);
  goal_.reset();
}

bool FirstMotion::begin(scene::Workspace& workspace) {
  const scene::Document& document = workspace.document;
  const std::filesystem::path file = std::exchange(file_, {});
  if (!workspace.view.hints || !document.has_cage() || scene::differs_from_rest(document) ||
      workspace.offers_recovery)
    return false;
  try {
    std::vector<std::string> warnings;
    goal_ = deform::read_pose(file, *document.cage, warnings);
  } catch (const base::Error&) {
    return false;  // harmless without the motion
  }
  return true;
}

void FirstMotion::place(scene::Workspace& workspace, double share) const {
  scene::Document& document = workspace.document;
  const auto& rest = document.cage->surface.positions;
  deform::Pose pose = *goal_;
  for (std::size_t v = 0; v < rest.size() && share < 1; ++v) {
    for (std::size_t k = 0; k < 3; ++k)
      pose.positions[v][k] = rest[v][k] + share * (goal_->positions[v][k] - rest[v][k]);
  }
  document.changed_pose() = std::move(pose);
  scene::mark_pose_saved(workspace);
}

bool motion_is_wanted() {
  const char* value = std::getenv("VIETE_REDUCED_MOTION");
  return !value || std::string_view(value).empty() || std::string_view(value) == "0";
}

}  // namespace viete::app
