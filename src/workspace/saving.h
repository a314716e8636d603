// Saving, and tracking of unsaved edits.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "document/files_in_use.h"
#include "files/session.h"
#include "workspace/workspace.h"

namespace viete::workspace {

/// Write the session, or the posed cage with its turns. Atomic; a message reports the file or the error.
/// Return true on success. Saving a session marks all edits as saved; saving a pose only those of the pose.
bool save_session(Workspace& workspace, const std::filesystem::path& path);
bool save_pose(Workspace& workspace, const std::filesystem::path& path);
/// Saves the cage at rest; it then belongs to this file. The pose is not included.
bool save_cage(Workspace& workspace, const std::filesystem::path& path);

/// Reports why a file cannot be read or written: in the file browser if it requested the file, otherwise as a
/// message.
void report_refusal(Workspace& workspace, const std::filesystem::path& file, const std::string& problem,
                    std::string_view topic);

/// True if Save would overwrite a session that changed since it was opened or saved here.
bool changed_on_disk(const Workspace& workspace, const std::filesystem::path& session);
/// The name of the session, or else of the model, with a star for unsaved edits.
std::string window_title(const Workspace& workspace);

/// True if the data that determines the model differs from what was opened or last saved: the pose with its
/// whole turns, unless it is the timeline's pose at this frame; named poses and keys; deformer settings and
/// selection sets. The method is excluded (all give the same model), as are camera, view and selection: a
/// session stores them, but losing them loses no work.
bool has_unsaved_edits(const Workspace& workspace);
/// Marks the document, or only its pose, as saved.
void mark_saved(Workspace& workspace);
void mark_pose_saved(Workspace& workspace);

/// The session of the current state.
files::Session session_of(const Workspace& workspace);

/// All open files, including the session and a binding, except the one described by `own`, which is about to
/// be overwritten.
document::FilesInUse files_open(const Workspace& workspace, std::string_view own = {});

/// The file name of the session, or else of the model: "dragon.ply".
std::string name_of_work(const Workspace& workspace);

}  // namespace viete::workspace
