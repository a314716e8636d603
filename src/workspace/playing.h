// Playback: shows the pose of the current frame in the document.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "workspace/workspace.h"

namespace viete::workspace {

/// For the current timeline; null without keys, and while the cage itself is edited.
std::shared_ptr<const document::Animation> animation_of(Workspace& workspace);

/// True if the current pose differs from the timeline's at this frame, so that changing the frame would lose
/// it.
bool has_unkeyed_pose(const Workspace& workspace);

/// Shows the frame: pose, probes and camera keys. An unkeyed pose can be restored by undo and is stored in
/// Timeline::unkeyed. Ends the mix. Ignored during a drag.
void go_to_frame(Workspace& workspace, double frame);
/// Goes to the next or previous frame with a key; wraps around.
void go_to_key(Workspace& workspace, bool forward);

/// The weight of each pose of the library in the current pose: of the mix, or of the keys at this frame.
std::vector<double> shown_weights(const Workspace& workspace);

/// Runs an edit that replaces the pose. An unkeyed pose that equals no named pose is stored in
/// Timeline::unkeyed.
void replace_pose(Workspace& workspace, const std::function<void()>& edit);
/// Applies a pose of the library with replace_pose(). Stops playback.
void apply_pose(Workspace& workspace, std::size_t pose);

/// Stops playback and runs the change; shows a message if it would exceed the drawable range.
void change_mix(Workspace& workspace, const std::function<bool()>& change);

/// For a newly opened document: adds the poses of Timeline::unkeyed to undo. With `show` the last of them is
/// shown if the document's pose is one of its keys.
void add_unkeyed_to_undo(Workspace& workspace, bool show);

/// Opens the timeline and fits all keys.
void show_timeline(Workspace& workspace);

void start_playing(Workspace& workspace);
/// Ends on a whole frame.
void stop_playing(Workspace& workspace);

/// Call once per frame of the window, `seconds` after the last one: advances playback, sets keys for edits of
/// the pose if auto-key is on, and shows edits of the timeline. An unkeyed edit of the pose stops playback,
/// so that it stays visible.
void follow_time(Workspace& workspace, double seconds);

/// The pose of the keys or the mix, computed linearly if the document uses log space, and vice versa; null
/// if neither is shown. May throw base::Error.
document::SharedPose pose_by_other_blending(Workspace& workspace);
/// True if keys or a mix exist: only then can linear and log space differ.
bool has_blended_pose(const Workspace& workspace);

/// Call once per frame, before the model is deformed: see PinPosing.
void follow_pins(Workspace& workspace);

}  // namespace viete::workspace
