// Applies the results of reading files to a workspace.
#pragma once

#include "files/open.h"
#include "workspace/workspace.h"

namespace viete::workspace {

/// Applies the result and reports its warnings as messages. The example is played, and Save asks for a name.
void apply_opened(Workspace& workspace, files::Opened&& opened);

/// Reads and applies in the foreground. On failure nothing changes and a message gives the reason. Returns
/// success.
bool open_now(Workspace& workspace, const files::OpenRequest& request);

}  // namespace viete::workspace
