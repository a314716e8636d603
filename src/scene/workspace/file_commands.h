// What the commands of the file group do.
#pragma once

#include "scene/workspace/workspace.h"

namespace viete::scene {

void browse_for_model(Workspace& workspace);
void browse_for_cage(Workspace& workspace);
void browse_for_pose(Workspace& workspace);
void browse_for_poses(Workspace& workspace);
void browse_for_animation(Workspace& workspace);
/// Writes where the session was saved last, or asks where.
void save(Workspace& workspace);
void browse_to_save_session(Workspace& workspace);
void browse_to_save_pose(Workspace& workspace);
void browse_to_save_cage(Workspace& workspace);
void browse_to_save_model(Workspace& workspace);
void browse_to_save_animation(Workspace& workspace);
/// The chosen one. Requires it.
void browse_to_save_named_pose(Workspace& workspace);

/// The leftover that was chosen, or the newest. Requires that there are some.
const Leftover& offered_leftover(const Workspace& workspace);
/// With that one: open it, move it aside until the program ends, or leave it for another day.
/// Require one.
void restore_leftover(Workspace& workspace);
void discard_leftover(Workspace& workspace);
void put_off_leftover(Workspace& workspace);
/// Brings back what was discarded last, or says no more of it. Require something discarded.
void undo_discard_leftover(Workspace& workspace);
void hide_discarded(Workspace& workspace);

}  // namespace viete::scene
