// Playback: shows the pose of the current frame in the document.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "workspace/workspace.h"

namespace viete::workspace {

/// The animation of the current timeline; null without keys, and during cage editing.
std::shared_ptr<const document::Animation> animation_of(Workspace& workspace);

/// True if the current pose differs from the timeline's pose at this frame.
bool has_unkeyed_pose(const Workspace& workspace);

/// Shows the pose, probes and camera of the keys at a frame. An unkeyed pose is stored in Timeline::unkeyed;
/// undo restores it. Sets the weights of named poses to 0. Does nothing during a drag.
void go_to_frame(Workspace& workspace, double frame);
/// Goes to the next or previous frame with a key; continues at the other end.
void go_to_key(Workspace& workspace, bool forward);

/// The weight of each named pose in the current pose, from the sliders or from the keys at this frame.
std::vector<double> shown_weights(const Workspace& workspace);

/// Runs an edit that replaces the pose. Stores the previous pose in Timeline::unkeyed if this pose is neither
/// a key nor a named pose.
void replace_pose(Workspace& workspace, const std::function<void()>& edit);
/// Stops playback and applies a named pose with replace_pose().
void apply_pose(Workspace& workspace, std::size_t pose);

/// Stops playback and runs a change of weights. If that fails, shows that the result is too large.
void change_mix(Workspace& workspace, const std::function<bool()>& change);

/// Adds the poses of Timeline::unkeyed to the undo history of a newly opened document. If `show`, and if the
/// document's pose equals the pose of the keys, shows the last of these poses.
void add_unkeyed_to_undo(Workspace& workspace, bool show);

/// Opens the timeline and makes all keys visible.
void show_timeline(Workspace& workspace);

void start_playing(Workspace& workspace);
/// Stops playback at a whole frame.
void stop_playing(Workspace& workspace);

/// Advances playback by `seconds`, shows edits of the timeline, and with auto_key sets keys for edits of the
/// pose. Call it once per frame of the window. Unkeyed edits stop playback, so that they stay visible.
void follow_time(Workspace& workspace, double seconds);

/// The pose of the keys or weights, computed linearly if the document uses log space, and vice versa; null if
/// the pose has another origin. May throw base::Error.
document::SharedPose pose_by_other_blending(Workspace& workspace);
/// True if there are keys or weights. Otherwise linear interpolation and log space are equal.
bool has_blended_pose(const Workspace& workspace);

/// Poses the model by its pins, see PinPosing. Call once per frame, before the model is deformed.
void follow_pins(Workspace& workspace);

}  // namespace viete::workspace
