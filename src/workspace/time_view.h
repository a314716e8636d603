// The timeline panel: visible frames, selected keys, and the mouse, which selects and drags keys and scrubs.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "workspace/workspace.h"

namespace viete::workspace {

/// The range that shows the playback range and all keys, with a margin.
FrameWindow fitting(const document::Timeline& timeline);
/// Zooms about the frame at the fraction `share` of the width. A factor above 1 zooms out.
FrameWindow zoomed(const FrameWindow& seen, double share, double factor);
/// The number of frames between ruler lines, for about `lines` lines: 1, 2, 5, 10, 20 ...
int ruler_step(const FrameWindow& seen, double lines);

/// Opens the timeline and makes all keys visible.
void show_timeline(Workspace& workspace);

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
