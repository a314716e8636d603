// A workspace takes what was read of files, at once.
#pragma once

#include "scene/files/open.h"
#include "scene/workspace/workspace.h"

namespace viete::scene {

/// Takes it into the workspace; messages say what is to be said.
void take(Workspace& workspace, Opened&& opened);

/// Opens at once, without reading aside. On failure everything stays as it was and a message says why.
/// Returns success.
bool open_now(Workspace& workspace, const OpenRequest& request);

/// Adds the poses of a session of the open model and cage, and its keys in place of those that are there: one
/// edit, which is saved work if all was saved before. The session itself is not opened, so that Save asks for
/// a name. On failure everything stays as it was and a message says why. Returns success.
bool add_motion(Workspace& workspace, const std::filesystem::path& session);

}  // namespace viete::scene
