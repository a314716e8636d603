#include "scene/workspace/file_commands.h"

#include <algorithm>

#include "scene/files/output.h"
#include "scene/workspace/saving.h"

namespace viete::scene {

namespace {

using Purpose = FileBrowser::Purpose;
namespace fs = std::filesystem;

// The file of the cage, or else of the model.
const fs::path& file_of_cage(const Document& document) {
  const bool in_file = document.has_cage() && !document.cage_file.path.empty();
  return in_file ? document.cage_file.path : document.model.path;
}

// Beside what it belongs to.
void browse_beside(Workspace& w, Purpose purpose, const fs::path& file) {
  std::error_code ignored;
  const bool there = fs::is_directory(file.parent_path(), ignored);
  show(w.browser, purpose, there ? file.parent_path() : w.remembered.folder);
}

// What a file of this purpose may replace though it is open: itself as it was read.
std::string_view own_of(Purpose purpose) {
  switch (purpose) {
    case Purpose::save_session: return the_session;
    case Purpose::save_pose: return the_pose;
    case Purpose::save_cage: return the_cage;
    default: return no_own;
  }
}

// "cage" becomes "cage_pose.obj", in the folder of the session or else beside the file it comes from.
void browse_to_save(Workspace& w, Purpose purpose, const fs::path& from, const std::string& ending) {
  const fs::path& beside = w.saved.session.empty() ? from : w.saved.session;
  show(w.browser, purpose, beside.parent_path(), from.stem().string() + ending,
       files_open(w, own_of(purpose)));
}

}  // namespace

void browse_for_model(Workspace& w) {
  // Where a file was chosen last, else beside what is open.
  const fs::path& last = w.remembered.folder;
  show(w.browser, Purpose::model, last.empty() ? file_of_cage(w.document).parent_path() : last);
}
void browse_for_cage(Workspace& w) {
  browse_beside(w, Purpose::cage, w.document.model.path);
}
void browse_for_pose(Workspace& w) {
  browse_beside(w, Purpose::pose, file_of_cage(w.document));
}
void browse_for_poses(Workspace& w) {
  browse_beside(w, Purpose::poses, file_of_cage(w.document));
}
void browse_for_animation(Workspace& w) {
  browse_beside(w, Purpose::animation, file_of_cage(w.document));
}

void save(Workspace& w) {
  if (w.saved.session.empty()) return browse_to_save_session(w);
  w.requests.save_session = w.saved.session;
}

void browse_to_save_session(Workspace& w) {
  browse_to_save(w, Purpose::save_session, w.saved.session.empty() ? w.document.model.path : w.saved.session,
                 ".viete");
}

void browse_to_save_pose(Workspace& w) {
  const bool in_file = !w.document.cage_file.path.empty();
  browse_to_save(w, Purpose::save_pose, in_file ? w.document.cage_file.path : w.document.model.path,
                 "_pose.obj");
}

void browse_to_save_named_pose(Workspace& w) {
  std::string name = w.document.library.poses[*w.chosen_pose].name;
  std::ranges::replace(name, '/', '_');
  const bool in_file = !w.document.cage_file.path.empty();
  browse_to_save(w, Purpose::save_named_pose, in_file ? w.document.cage_file.path : w.document.model.path,
                 "_" + name + ".obj");
}

void browse_to_save_cage(Workspace& w) {
  browse_to_save(w, Purpose::save_cage, w.document.model.path, "_cage.obj");
}

void browse_to_save_model(Workspace& w) {
  browse_to_save(w, Purpose::save_model, w.document.model.path, "_deformed.obj");
}

void browse_to_save_animation(Workspace& w) {
  browse_to_save(w, Purpose::save_animation, w.document.model.path, "_animation.pc2");
  const glm::ivec2 size = glm::clamp(glm::ivec2(w.viewport.window), least_picture, largest_picture);
  w.browser.pictures = PictureChoice{w.view.cage, w.view.grid, !w.view.dark, false, size.x, size.y};
}

const Leftover& offered_leftover(const Workspace& w) {
  const auto chosen = std::ranges::find(w.leftovers, w.chosen_leftover, &Leftover::file);
  return chosen == w.leftovers.end() ? w.leftovers.front() : *chosen;
}

void restore_leftover(Workspace& w) {
  w.requests.open = OpenRequest{OpenRequest::What::recovery, {offered_leftover(w).file}};
}

void discard_leftover(Workspace& w) {
  w.requests.discard = offered_leftover(w).file;
}

void undo_discard_leftover(Workspace& w) {
  w.requests.undo_discard = true;
}

void hide_discarded(Workspace& w) {
  w.tell_discarded = false;
}

void put_off_leftover(Workspace& w) {
  w.leftovers.erase(w.leftovers.begin() + (&offered_leftover(w) - w.leftovers.data()));
}

}  // namespace viete::scene
