// Showing a finding of the checks in the view, and stepping through its elements.
#pragma once

#include <span>

#include "scene/workspace/workspace.h"

namespace viete::scene {

/// Highlights a finding and requests the camera to frame it; hides it if it is shown already.
void toggle_finding(Workspace& workspace, std::size_t index);

/// Shows only the next (1) or previous (-1) element of the shown finding; wraps around.
void step_element(Workspace& workspace, int step);

/// Frames the shown elements. `positions`: the displayed positions of the finding's surface, in the file's
/// units.
void frame_finding(Workspace& workspace, std::span<const mesh::Point> positions);

}  // namespace viete::scene
