// Applies a transform to the grip, keeping branches and whole turns continuous.
#pragma once

#include <string>

#include "document/document.h"
#include "interact/grip.h"
#include "interact/transform.h"

namespace viete::interact {

/// Transforms the vertices of the grip from their positions in `before`, about the grip's anchor. If the
/// rotation differs from `degrees_seen`, the one currently shown, by more than a mouse moves per frame, it is
/// applied in small steps, so that the pose's whole turns equal those of a slow rotation. |degrees| is at
/// most most_degrees. Returns false, without a change, if a vertex or the turns would leave their range
/// (scene/document/range.h). If probes are selected, transforms those instead.
bool place(document::Document& document, const document::DocumentState& before, const Grip& grip,
           const Transform& transform, double degrees_seen);

/// Call after a finished rotation from `before`: parts of the cage that were rotated rigidly get their whole
/// turns about the axis, in any pose, even if the logs of their elements cannot resolve them.
void count_whole_turns(document::Document& document, const document::DocumentState& before, const Grip& grip,
                       const Transform& transform);

/// The complete edit, one history entry; nothing is recorded if nothing moves. Requires a selection. Returns
/// false, without a change, if it would leave the range of a pose.
bool transform_selection(document::Document& document, Tool tool, const Grip& grip,
                         const Transform& transform);

/// The name of the edit in the history, such as "rotate 3 faces".
std::string edit_label(Tool tool, const document::Selection& selection);

/// Transforms the probes selected in `before` from their places there. Returns false, without a change, if
/// one would leave its range.
bool place_probes(document::Document& document, const document::DocumentState& before,
                  const Transform& transform);

}  // namespace viete::interact
