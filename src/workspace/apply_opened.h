// Applies the results of reading files to a workspace.
#pragma once

#include "files/open.h"
#include "workspace/workspace.h"

namespace viete::workspace {

/// Replaces the document, or adds opened poses, shapes or keys to the document. Shows warnings as messages.
/// If the file is the example, plays the animation.
void apply_opened(Workspace& workspace, files::Opened&& opened);

/// Reads the files and calls apply_opened(). On failure, shows the error, changes nothing and returns false.
bool open_now(Workspace& workspace, const files::OpenRequest& request);

}  // namespace viete::workspace
