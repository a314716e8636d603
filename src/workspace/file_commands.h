// Implementation of the file commands.
#pragma once

#include "workspace/workspace.h"

namespace viete::workspace {

/// Saves to the session's file. If the session has no file, opens the browser.
void save(Workspace& workspace);
void browse_to_save_session(Workspace& workspace);
/// Opens the browser in the session's folder to find a missing model or cage. `unopened` must be set.
void browse_to_locate(Workspace& workspace, FileBrowser::Purpose purpose);

}  // namespace viete::workspace
