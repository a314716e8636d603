// Applies the results of reading files to a workspace.
#pragma once

#include "scene/files/open.h"
#include "scene/workspace/workspace.h"

namespace viete::scene {

/// Applies the result and reports its warnings as messages.
void apply_opened(Workspace& workspace, Opened&& opened);

/// Reads and applies in the foreground. On failure nothing changes and a message gives the reason. Returns
/// success.
bool open_now(Workspace& workspace, const OpenRequest& request);

/// Adds the poses of a session of the same model and cage, and replaces the keys: one edit, which counts as
/// saved if all was saved before. The session itself is not opened, so Save asks for a name. On failure
/// nothing changes and a message gives the reason. Returns success.
bool add_motion(Workspace& workspace, const std::filesystem::path& session);

}  // namespace viete::scene
