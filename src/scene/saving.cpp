#include "scene/saving.h"

#include <utility>

#include "base/atomic_file.h"
#include "deform/pose_io.h"
#include "mesh/source.h"
#include "mesh/write.h"
#include "scene/session.h"

namespace viete::scene {

namespace fs = std::filesystem;

namespace {

// Runs a step that writes; what goes wrong becomes a message.
template <class Step>
bool attempt(Workspace& workspace, const char* what, const fs::path& path, Step step) {
  try {
    step();
    workspace.messages.info(std::string("Saved the ") + what + " to " + path.string());
    return true;
  } catch (const std::exception& error) {
    workspace.messages.error(error.what());
    return false;
  }
}

}  // namespace

bool save_session(Workspace& workspace, const fs::path& path) {
  return attempt(workspace, "session", path, [&] {
    base::replace_file(path, session_text(session_of(workspace), path));
    workspace.saved.session = path;
    workspace.remembered.add({path, {}});
    mark_saved(workspace);
  });
}

bool save_pose(Workspace& workspace, const fs::path& path) {
  return attempt(workspace, "pose", path, [&] {
    deform::write_pose(path, *workspace.document.cage, workspace.document.pose);
    if (mesh::extension_of(path) != "stl") mark_saved(workspace);
  });
}

bool save_model(Workspace& workspace, const fs::path& path, std::span<const mesh::Point> positions) {
  return attempt(workspace, "deformed model", path, [&] {
    mesh::Surface deformed = *workspace.document.model.surface;
    deformed.positions.assign(positions.begin(), positions.end());
    mesh::write(path, deformed);
  });
}

bool has_unsaved_edits(const Workspace& workspace) {
  return workspace.document.has_cage() && workspace.document.pose.positions != workspace.saved.positions;
}

void mark_saved(Workspace& workspace) {
  workspace.saved.positions = workspace.document.pose.positions;
  ++workspace.saved.revision;
}

}  // namespace viete::scene
