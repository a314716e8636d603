// Edits of the timeline. Each is undoable.
#pragma once

#include <span>

#include "document/document.h"
#include "document/pose_edit.h"

namespace viete::document {

/// The document's frame, rounded.
int current_frame(const Document& document);

/// Sets a key of the current pose at that frame. An existing key is replaced and keeps its easing; the range
/// grows to include it. `weights`: those of the library's poses in the current pose; empty: the library's
/// own. Throws base::Error beyond Timeline::most_keys, or if the frame is out of range.
void set_key(Document& document, int frame, std::span<const double> weights = {});
/// As set_key(), as part of the last edit.
void add_key_to_edit(Document& document, int frame);
/// Sets a camera key; adds whole turns to its yaw so that it is nearest to that of the previous camera key.
void set_camera_key(Document& document, int frame, const CameraPose& camera);
/// One full turn of the camera about the up axis over the playback range, at constant speed and so that the
/// last frame repeats the first; replaces all other camera keys.
void set_turntable(Document& document, const CameraPose& camera);
/// Frames in any order; frames without a key are ignored.
void remove_keys(Document& document, std::span<const int> frames);
/// Moves keys and camera keys from `frames` to the frames `to`, one each; they replace other keys there.
/// Consecutive moves from the same timeline `before`, as in one drag, are one edit.
void move_keys(Document& document, const Timeline& before, std::span<const int> frames,
               std::span<const int> to);
void set_easing(Document& document, std::span<const int> frames, Easing easing);
/// Replaces all keys, range and rate by those of a file.
void put_timeline(Document& document, Timeline timeline, const std::string& label);
/// Consecutive changes are one edit. Values are clamped.
void set_play(Document& document, const Playing& play);

}  // namespace viete::document
