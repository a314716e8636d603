// Edits of the timeline. Each edit is undoable.
#pragma once

#include <optional>
#include <span>

#include "document/document.h"
#include "document/pose_edit.h"

namespace viete::document {

/// Returns the current frame, rounded to an integer.
int current_frame(const Document& document);

/// Returns the timeline with the current pose as a key. If the frame has a key, keeps the key's easing.
/// Extends the playback range to the frame. `weights` are the weights of the named poses in the current pose;
/// if empty, uses the weights of the pose list. The key does not contain poses with keyed weights: where such
/// a weight differs from its channel, it gets a key, too. `vectors` may be null. If the timeline is full or
/// the frame is out of range, throws base::Error.
Timeline with_key(const Document& document, int frame, std::span<const double> weights = {},
                  VectorCache* vectors = nullptr);
/// Returns the timeline with a key of the pose's weight in its channel. Otherwise like with_key().
Timeline with_weight_key(Timeline timeline, const NamedPose& pose, int frame, double weight);
void set_key(Document& document, int frame, std::span<const double> weights = {},
             VectorCache* vectors = nullptr);
void set_weight_key(Document& document, std::size_t pose, int frame, double weight);
/// Sets a camera key. Adds whole turns to the yaw until the yaw is nearest to the previous key's yaw.
void set_camera_key(Document& document, int frame, const CameraPose& camera);
/// Replaces all camera keys by a full turn about the up axis, at constant speed during the playback range.
void set_turntable(Document& document, const CameraPose& camera);
/// Removes keys. Ignores places without a key.
void remove_keys(Document& document, std::span<const KeyPlace> places);
/// Moves the keys of `places` to the frames `to`, and replaces other keys there. `before` is the timeline
/// before the drag. Consecutive moves in one drag form one edit.
void move_keys(Document& document, const Timeline& before, std::span<const KeyPlace> places,
               std::span<const int> to);
/// Ignores camera keys.
void set_easing(Document& document, std::span<const KeyPlace> places, Easing easing);
/// Returns the easing of a key; nullopt without a key, and for camera keys.
std::optional<Easing> easing_at(const Timeline& timeline, const KeyPlace& place);
void put_timeline(Document& document, Timeline timeline, const std::string& label);
/// Sets the playback settings, clamped to their ranges. Consecutive changes form one edit.
void set_play(Document& document, const Playing& play);

}  // namespace viete::document
