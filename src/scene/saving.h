// Saving, and what is not saved yet.
#pragma once

#include <filesystem>
#include <span>

#include "scene/workspace.h"

namespace viete::scene {

/// Write the session, the posed cage with its turns, or the model with these positions. Atomic; a message
/// says where, or what went wrong, and then the file is as it was. Return success. A session or a pose that
/// keeps every vertex (not STL) makes the edits saved.
bool save_session(Workspace& workspace, const std::filesystem::path& path);
bool save_pose(Workspace& workspace, const std::filesystem::path& path);
bool save_model(Workspace& workspace, const std::filesystem::path& path,
                std::span<const mesh::Point> positions);

/// True if the pose is neither the one that was opened nor the one that was saved last.
bool has_unsaved_edits(const Workspace& workspace);
/// What is open now is safe.
void mark_saved(Workspace& workspace);

}  // namespace viete::scene
