// The mouse on the timeline: keys are selected and dragged, frames are gone to.
#pragma once

#include <optional>
#include <vector>

#include "scene/workspace/workspace.h"

namespace viete::scene {

/// Selected frames that have a key.
std::vector<int> selected_keys(const Workspace& workspace);
/// Those whose easing is shown and chosen: the selected ones that come to another, or else the last one at or
/// before the frame that is shown.
std::vector<int> eased_keys(const Workspace& workspace);

/// A press on a frame: on a key (of either kind) it selects, `add` toggles, and a drag takes the selected
/// along; anywhere else it begins a box.
void press_keys(Workspace& workspace, double frame, std::optional<int> key, bool add);
/// In the ruler: goes there.
void press_ruler(Workspace& workspace, double frame);
void press_pan(Workspace& workspace, double frame);
/// The mouse is over that frame of the window as it was when it was pressed.
void drag_time(Workspace& workspace, double frame);
void release_time(Workspace& workspace);
/// Esc: as it was before the press.
void cancel_time(Workspace& workspace);

}  // namespace viete::scene
