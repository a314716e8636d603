// What the commands of the file group do.
#pragma once

#include "scene/workspace/workspace.h"

namespace viete::scene {

/// Writes where the session was saved last, or asks where.
void save(Workspace& workspace);
void browse_to_save_session(Workspace& workspace);
/// The chosen one. Requires it.
void browse_to_save_named_pose(Workspace& workspace);
/// The file that a question asks for, beside the session. Requires an unopened one.
void browse_to_locate(Workspace& workspace, FileBrowser::Purpose purpose);

}  // namespace viete::scene
