// Edits of the timeline. Each is undoable.
#pragma once

#include <span>
#include <vector>

#include "scene/document/document.h"
#include "scene/document/pose_edit.h"

namespace viete::scene {

/// The nearest whole frame to where the document is.
int current_frame(const Document& document);

/// A key of what is there now, at that frame; one that is there is replaced, its easing kept. The range grows
/// with it. `weights` are those of the library's poses in what is there; empty: as the library mixes them.
/// Throws base::Error beyond Timeline::most_keys, or where the frame is out of range.
void set_key(Document& document, int frame, std::span<const double> weights = {});
/// The same as a part of the edit that was just made.
void add_key_to_edit(Document& document, int frame);
/// Its yaw is taken on the branch that is nearest to the camera key before.
void set_camera_key(Document& document, int frame, const CameraPose& camera);
/// One whole turn of the camera about the up axis, over the range of what plays, at an even speed and so that
/// the last frame is the first one again: these take the place of all other camera keys. `turns` may be
/// several, or negative: the other way round.
void set_turntable(Document& document, const CameraPose& camera, int turns = 1);
/// Of frames in any order; those without a key are passed over.
void remove_keys(Document& document, std::span<const int> frames);
/// Keys and camera keys of these frames go to `to`, one each; keys of others that are there give way. Moves
/// one after the other from the same timeline `before` are one edit: those of one drag.
void move_keys(Document& document, const Timeline& before, std::span<const int> frames,
               std::span<const int> to);
void set_easing(Document& document, std::span<const int> frames, Easing easing);
/// Keys that were read take the place of all others, with range and rate.
void put_timeline(Document& document, Timeline timeline, const std::string& label);
/// Range, rate, what comes after the last frame, straight lines; changes one after the other are one edit.
/// Values are brought into their ranges.
struct Play {
  int first, last;
  double rate;
  Repeat repeat;
  bool straight;

  friend bool operator==(const Play&, const Play&) = default;
};
Play play_of(const Timeline& timeline);
void set_play(Document& document, const Play& play);

}  // namespace viete::scene
