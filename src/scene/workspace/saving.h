// Saving, and what is not saved yet.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "scene/document/files_in_use.h"
#include "scene/files/session.h"
#include "scene/workspace/workspace.h"

namespace viete::scene {

/// Write the session, or the posed cage with its turns. Atomic; a message says where, or what went wrong, and
/// then the file is as it was. Return success. A session makes all edits saved, a pose those of the pose.
bool save_session(Workspace& workspace, const std::filesystem::path& path);
bool save_pose(Workspace& workspace, const std::filesystem::path& path);
bool save_chosen_pose(Workspace& workspace, const std::filesystem::path& path);  ///< of the named ones
/// The cage at rest, which is then that of this file. The pose is not in it.
bool save_cage(Workspace& workspace, const std::filesystem::path& path);

/// Says why a file that was asked for cannot be read or written: in the file dialog if that asked for it, or
/// else in the messages.
void tell_refusal(Workspace& workspace, const std::filesystem::path& file, const std::string& problem,
                  std::string_view topic);

/// True if Save would replace a session that is not the one that was opened or saved here last.
bool changed_on_disk(const Workspace& workspace, const std::filesystem::path& session);
/// Of the window: the session, or else the model, that is open, with a star while edits are unsaved.
std::string window_title(const Workspace& workspace);

/// True if what shapes the model is neither what was opened nor what was saved last: the pose, its whole
/// turns included, unless it is what the keys make of the frame; poses with names, and keys; coordinates and
/// reach, or sets by name. The method is not among it (every one gives the
/// same model), nor are camera, view and selection: a session keeps them, but they are no work that could be
/// lost.
bool has_unsaved_edits(const Workspace& workspace);
/// What is open now is safe, or only its pose.
void mark_saved(Workspace& workspace);
void mark_pose_saved(Workspace& workspace);
/// Edits from now on are told by the first of them; of recovered work by one that was before.
void mark_edits_saved(Workspace& workspace, const std::string& first_edit);

/// All that makes the picture.
Session session_of(const Workspace& workspace);

/// All that is open, the session and a binding included, but for the one of `own`, which is to be written
/// anew: what it was read as.
FilesInUse files_open(const Workspace& workspace, std::string_view own = {});

/// The file of the session, or else of the model, that edits belong to: "dragon.ply".
std::string name_of_work(const Workspace& workspace);

}  // namespace viete::scene
