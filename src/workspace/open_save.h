// Opening and saving, and tracking of unsaved edits.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "document/files_in_use.h"
#include "files/open.h"
#include "files/session.h"
#include "workspace/workspace.h"

namespace viete::workspace {

/// Writes the session atomically and marks all edits as saved. Shows a message. Returns true on success.
bool save_session(Workspace& workspace, const std::filesystem::path& path);
/// Writes the posed cage and Pose::turns. Otherwise like save_session(), but marks only the pose as saved.
bool save_pose(Workspace& workspace, const std::filesystem::path& path);
/// Saves the cage at rest. Afterwards the cage belongs to this file.
bool save_cage(Workspace& workspace, const std::filesystem::path& path);

/// The names of the document's files that were moved or deleted: "model.obj and cage.obj"; empty if none.
std::string moved_files(const Workspace& workspace);
/// Writes the meshes of these files beside a session, and lets the document refer to the new files. Shows
/// messages. Returns true on success.
bool save_moved_files(Workspace& workspace, const std::filesystem::path& session);

/// Shows why a file cannot be read or written: in the browser that requested the file, or as a message.
void report_refusal(Workspace& workspace, const std::filesystem::path& file, const std::string& problem,
                    std::string_view topic);

/// True if another program has changed the session since it was opened or saved.
bool changed_on_disk(const Workspace& workspace, const std::filesystem::path& session);
/// The title of the window: the name of the session or model, with a star for unsaved edits.
std::string window_title(const Workspace& workspace);

/// True if the document differs from the state that was opened or saved last: in cage, pose, named poses,
/// keys, probes, mask, selection sets or deformer settings. A pose that comes from the keys does not count.
/// The method, camera, view and selection do not count either, although a session stores their values.
bool has_unsaved_edits(const Workspace& workspace);
/// True if the document has edits that `saved`, whose pose is the real_pose(), does not have.
bool differs(const Workspace& workspace, const document::DocumentState& saved);
/// Marks the document, or only its pose, as saved.
void mark_saved(Workspace& workspace);
void mark_pose_saved(Workspace& workspace);

files::Session session_of(const Workspace& workspace);

/// All open files, except the file with the name `own` ("the cage"): the caller may overwrite this file.
document::FilesInUse files_open(const Workspace& workspace, std::string_view own = {});

/// The file name of the session, or of the model if there is no session: "dragon.ply".
std::string name_of_work(const Workspace& workspace);

/// Saves to the session's file. If the session has no file, opens the browser.
void save(Workspace& workspace);
void browse_to_save_session(Workspace& workspace);
/// Opens the browser in the session's folder to find a missing model or cage. `unopened` must be set.
void browse_to_locate(Workspace& workspace, FileBrowser::Purpose purpose);

/// Replaces the document, or adds opened poses, shapes or keys to the document. Shows warnings as messages.
/// If the file is the example, plays the animation.
void apply_opened(Workspace& workspace, files::Opened&& opened);

}  // namespace viete::workspace
