// Implementation of the file commands.
#pragma once

#include "workspace/workspace.h"

namespace viete::workspace {

/// Saves to the session's file, or opens the browser if it has none.
void save(Workspace& workspace);
void browse_to_save_session(Workspace& workspace);
/// Locates the file that a question asks for, in the session's folder. Requires `unopened`.
void browse_to_locate(Workspace& workspace, FileBrowser::Purpose purpose);

}  // namespace viete::workspace
