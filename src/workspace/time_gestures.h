// Mouse gestures on the timeline: selecting and dragging keys, scrubbing.
#pragma once

#include <optional>
#include <vector>

#include "workspace/workspace.h"

namespace viete::workspace {

/// Selected frames with a key.
std::vector<int> selected_keys(const Workspace& workspace);
/// The keys whose easing is shown and edited: selected ones with a successor, or else the last one at or
/// before the current frame.
std::vector<int> eased_keys(const Workspace& workspace);

/// A press on a frame: on a key (of either kind) selects it, toggles it with `add`, and starts dragging the
/// selection; elsewhere starts a box.
void press_keys(Workspace& workspace, double frame, std::optional<int> key, bool add);
/// A press in the ruler: goes to the frame.
void press_ruler(Workspace& workspace, double frame);
void press_pan(Workspace& workspace, double frame);
/// Continues a drag. `frame` is the frame under the mouse in the frame window at the press.
void drag_time(Workspace& workspace, double frame);
void release_time(Workspace& workspace);
/// Esc: restores the state before the press.
void cancel_time(Workspace& workspace);

}  // namespace viete::workspace
