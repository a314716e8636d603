// Applies the results of reading files to a workspace.
#pragma once

#include "files/open.h"
#include "workspace/workspace.h"

namespace viete::workspace {

/// Replaces the document, or adds opened poses, shapes or keys to the document. Shows warnings as messages.
/// If the file is the example, plays the animation.
void apply_opened(Workspace& workspace, files::Opened&& opened);

}  // namespace viete::workspace
