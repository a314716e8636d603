// Mouse gestures on the timeline: selecting and dragging keys, scrubbing.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "workspace/workspace.h"

namespace viete::workspace {

/// The selected keys that exist.
KeyPlaces selected_keys(const Workspace& workspace);
/// The keys whose easing is edited: the selected keys that have a next key. If no such key is selected, the
/// last pose key at or before the current frame.
KeyPlaces eased_keys(const Workspace& workspace);

/// A mouse press at `frame`. If `key` is set, selects this key and starts to drag the selected keys; with
/// `add`, only toggles this key. Otherwise starts a box selection.
void press_keys(Workspace& workspace, double frame, const std::optional<document::KeyPlace>& key, bool add);
/// A press in the ruler: goes to the frame.
void press_ruler(Workspace& workspace, double frame);
void press_pan(Workspace& workspace, double frame);
/// Continues a drag to `frame`. For a pan, compute `frame` with Drag::seen, the frames visible at the press.
/// A box selects only keys of the channels `rows`; an empty name: keys of poses and cameras.
void drag_time(Workspace& workspace, double frame, std::span<const std::string> rows = {});
void release_time(Workspace& workspace);
/// Cancels a drag: restores the state before the press.
void cancel_time(Workspace& workspace);

}  // namespace viete::workspace
