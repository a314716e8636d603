#include "app/bundled_loop.h"

#include <utility>

#include "base/error.h"
#include "scene/files/pose_json.h"
#include "scene/files/session.h"

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

bool add_loop(scene::Workspace& w, const std::filesystem::path& file) {
  scene::Document& document = w.document;
  if (!is_untouched(document) || !w.saved.session.empty() || w.saved.nowhere) return false;
  try {
    scene::Session session = scene::read_session(file);
    if (!same_file(session.model, document.model.path) || !same_file(session.cage, document.cage_file.path))
      return false;
    scene::fit_poses(session.library, session.timeline, document.cage.get(), file.string(), session.warnings);
    if (!session.warnings.empty()) return false;  // nothing is missing but a show
    document.library = w.saved.state.library = std::move(session.library);
    document.timeline = w.saved.state.timeline = std::move(session.timeline);
    document.frame = session.frame;
  } catch (const base::Error&) {
    return false;
  }
  return true;
}

}  // namespace viete::app
