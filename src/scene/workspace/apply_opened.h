// Applies the results of reading files to a workspace.
#pragma once

#include "scene/files/open.h"
#include "scene/workspace/workspace.h"

namespace viete::scene {

/// Applies the result and reports its warnings as messages. The example is played, and Save asks for a name.
void apply_opened(Workspace& workspace, Opened&& opened);

/// Reads and applies in the foreground. On failure nothing changes and a message gives the reason. Returns
/// success.
bool open_now(Workspace& workspace, const OpenRequest& request);

}  // namespace viete::scene
