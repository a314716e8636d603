// Playback: shows the pose of the current frame in the document.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "workspace/workspace.h"

namespace viete::workspace {

/// The animation of the current timeline. Null if there are no keys, and during cage editing.
std::shared_ptr<const document::Animation> animation_of(Workspace& workspace);

/// True if there are keys, and the current pose differs from the pose of the keys at this frame.
bool has_unkeyed_pose(const Workspace& workspace);

/// Shows the pose, probes and camera of the keys at a frame. Stores an unkeyed pose in Timeline::unkeyed;
/// undo restores this pose. Sets the weights of named poses to 0. Does nothing during a drag or cage editing.
void go_to_frame(Workspace& workspace, double frame);
/// Goes to the next or previous frame with a key. From the last key, goes to the first key, and vice versa.
void go_to_key(Workspace& workspace, bool forward);

/// The weight of each named pose in the current pose, from the sliders or from the keys at this frame. If
/// there are keyed weights, an edit of the keyed pose does not change them, unless it resets the pose.
std::vector<double> shown_weights(const Workspace& workspace);
/// The shown weight without the share that the pose keys at this frame contain: the weight for a channel.
double weight_upon_keys(const Workspace& workspace, std::size_t pose);
/// Shows the pose of the keys at the current frame, if there are keys. Discards an unkeyed pose.
void show_keys(Workspace& workspace);

/// Runs an edit that replaces the pose. If no key and no named pose has the previous pose, stores the
/// previous pose in Timeline::unkeyed.
void replace_pose(Workspace& workspace, const std::function<void()>& edit);
/// Stops playback and applies a named pose with replace_pose().
void apply_pose(Workspace& workspace, std::size_t pose);

/// Stops playback and calls `change`, which changes weights. If `change` returns false, shows an error.
void change_mix(Workspace& workspace, const std::function<bool()>& change);

/// Adds the poses of Timeline::unkeyed to the undo history of a newly opened document. If `show` is true and
/// the document's pose equals the pose of the keys, also shows the last pose of Timeline::unkeyed.
void add_unkeyed_to_undo(Workspace& workspace, bool show);

void start_playing(Workspace& workspace);
/// Stops playback and rounds the frame to an integer.
void stop_playing(Workspace& workspace);

/// True if follow_time() would do something now.
bool time_is_due(const Workspace& workspace);
/// Call this once per drawn picture. Advances playback by `seconds`. After an edit of the timeline, shows the
/// new pose. After an edit of the pose, sets a key if auto_key is on, otherwise stops playback.
void follow_time(Workspace& workspace, double seconds);

/// The pose of the keys or weights, but with the blending that the document does not use: linear or in log
/// space. Null if the pose does not come from keys or weights. May throw base::Error.
document::SharedPose pose_by_other_blending(Workspace& workspace);
/// True if there are keys or weights. Otherwise linear and log-space blending give the same pose.
bool has_blended_pose(const Workspace& workspace);

/// Poses the model by its pins, see PinPosing. Call once per drawn picture, before the model is deformed.
void follow_pins(Workspace& workspace);

}  // namespace viete::workspace
