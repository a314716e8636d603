// Time passes: the document shows the pose of its frame.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "scene/workspace/workspace.h"

namespace viete::scene {

/// Of the timeline as it is now; null where it has no keys, or while the cage itself is edited.
std::shared_ptr<const Animation> animation_of(Workspace& workspace);

/// True if what is there is not what time would show at this frame, so that going to another frame and back
/// would change it.
bool has_unkeyed_pose(const Workspace& workspace);

/// Shows the frame: pose, probes and camera keys. A pose that is in no key is not lost: undo leads back to
/// it, and Timeline::unkeyed keeps it. Ends the mix. Does nothing while something is in the hand.
void go_to_frame(Workspace& workspace, double frame);
/// To the next frame that has a key, or the one before; from the last one to the first.
void go_to_key(Workspace& workspace, bool forward);

/// How much of each pose of the library is in what is shown: as the mix has it, or as the keys that play do.
std::vector<double> shown_weights(const Workspace& workspace);

/// An edit that puts another pose in the place of what is there. If that was in no key, and no pose with a
/// name is like it, Timeline::unkeyed keeps it.
void replace_pose(Workspace& workspace, const std::function<void()>& edit);
/// The pose of the library, as such an edit. Ends the playing.
void apply_pose(Workspace& workspace, std::size_t pose);

/// Of a document that was just opened: undo leads back to the poses of Timeline::unkeyed. `show` begins with
/// the last of them where the document's own pose is one of its keys.
void lead_back_to_unkeyed(Workspace& workspace, bool show);

/// Opens the timeline, with all keys in sight.
void show_timeline(Workspace& workspace);

void start_playing(Workspace& workspace);
/// Where it comes to rest is a whole frame.
void stop_playing(Workspace& workspace);

/// Once a frame of the window, `seconds` after the last one: plays; keys what a hand has changed, if that is
/// wanted; and shows what an edit of the timeline has made of this frame. An edit of the pose that is not
/// keyed ends the playing, so that it is there to be seen.
void follow_time(Workspace& workspace, double seconds);

/// What keys or sliders have put there, if it was made in straight lines where it is in log space, and the
/// other way round; null where neither has made it. May throw base::Error.
SharedPose pose_by_other_lines(Workspace& workspace);
/// True if there is something that lines make a difference to: keys, or a mix.
bool has_lines(const Workspace& workspace);

/// Once a frame, before the model is deformed: the model follows its pins, see PinPosing.
void follow_pins(Workspace& workspace);

}  // namespace viete::scene
