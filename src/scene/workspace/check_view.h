// Which finding of the checks is shown in the view, and stepping through its elements.
#pragma once

#include <span>

#include "scene/workspace/workspace.h"

namespace viete::scene {

/// Highlights a finding and asks the program to frame it; the one that is shown is hidden again.
void toggle_finding(Workspace& workspace, std::size_t index);

/// The next (1) or previous (-1) element of the finding that is shown, alone; round and round.
void step_element(Workspace& workspace, int step);

/// Moves the camera to what is shown. `positions` are those of the finding's surface as it is seen now, in
/// the file's units.
void frame_finding(Workspace& workspace, std::span<const mesh::Point> positions);

}  // namespace viete::scene
