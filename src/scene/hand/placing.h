// What is in the hand goes where a transform takes it, branches and whole turns followed.
#pragma once

#include <string>

#include "scene/document/document.h"
#include "scene/hand/grip.h"
#include "scene/hand/transform.h"

namespace viete::scene {

/// Puts the vertices of the grip where the transform takes them from their place in `before`, about the
/// grip's pivots. If the turn differs from `degrees_seen`, the transform that the document shows, by more
/// than a mouse can turn in a frame, it is followed in small steps, so that the pose's whole turns are what a
/// slow turn would have made them. |degrees| is at most most_degrees. False, and the pose is as it was
/// before, if a vertex or the turns would leave their range (scene/document/range.h). Selected probes go
/// along instead where they are what is selected.
bool place(Document& document, const DocumentState& before, const Grip& grip, const Transform& transform,
           double degrees_seen);

/// After a turn has come to its end, from `before`: parts of the cage that turned as a whole have the whole
/// turns that they have made about its axis, in any pose, also where the logs of their elements cannot tell.
void keep_whole_turns(Document& document, const DocumentState& before, const Grip& grip,
                      const Transform& transform);

/// The whole edit at once, one entry of the history; nothing is recorded if nothing moves. Requires
/// a selection. False if it would leave the range of a pose: then nothing moves.
bool transform_selection(Document& document, Tool tool, const Grip& grip, const Transform& transform);

/// "rotate 3 faces".
std::string edit_label(Tool tool, const Selection& selection);

/// Puts the probes that were selected in `before` where the transform takes them from where they were then.
/// False, and they are as they were, if one would leave its range.
bool place_probes(Document& document, const DocumentState& before, const Transform& transform);

}  // namespace viete::scene
