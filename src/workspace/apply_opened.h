// Applies the results of reading files to a workspace.
#pragma once

#include "files/open.h"
#include "workspace/workspace.h"

namespace viete::workspace {

/// Shows the opened document, and its warnings as messages. Plays the example animation.
void apply_opened(Workspace& workspace, files::Opened&& opened);

/// Reads the files and calls apply_opened(). On failure, shows the error, changes nothing and returns false.
bool open_now(Workspace& workspace, const files::OpenRequest& request);

}  // namespace viete::workspace
