#include "app/first_motion.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "base/error.h"
#include "deform/pose_io.h"
#include "scene/document/edit.h"
#include "scene/files/pose_json.h"
#include "scene/files/session.h"
#include "scene/workspace/saving.h"

namespace viete::app {

namespace {

bool is_untouched(const scene::Document& document) {
  return document.has_cage() && document.library.poses.empty() && document.timeline.empty() &&
         !document.history.can_undo() && !document.history.can_redo();
}

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code ignored;
  return std::filesystem::equivalent(a, b, ignored);
}

}  // namespace

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
      workspace.offers_leftovers)
    return false;
  try {
    std::vector<std::string> warnings;
    goal_ = deform::read_pose(file, *document.cage, warnings);
  } catch (const base::Error&) {
    return false;  // nothing is missing but a welcome
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

bool add_loop(scene::Workspace& w, const std::filesystem::path& file) {
  scene::Document& document = w.document;
  if (!is_untouched(document) || !w.saved.session.empty() || w.saved.nowhere) return false;
  try {
    scene::Session session = scene::read_session(file);
    if (!same_file(session.model, document.model.path) || !same_file(session.cage, document.cage_file.path))
      return false;
    scene::fit_poses(session.library, session.timeline, document.cage.get(), *document.model.surface,
                     file.string(), session.warnings);
    if (!session.warnings.empty()) return false;  // nothing is missing but a show
    document.library = w.saved.state.library = std::move(session.library);
    document.timeline = w.saved.state.timeline = std::move(session.timeline);
    document.frame = session.frame;
  } catch (const base::Error&) {
    return false;
  }
  return true;
}

bool motion_is_wanted() {
  const char* value = std::getenv("VIETE_REDUCED_MOTION");
  return !value || std::string_view(value).empty() || std::string_view(value) == "0";
}

}  // namespace viete::app
