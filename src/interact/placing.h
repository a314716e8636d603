// Transforms the grip, and counts whole turns of the cage's parts.
#pragma once

#include <string>

#include "document/document.h"
#include "interact/grip.h"
#include "interact/transform.h"

namespace viete::interact {

/// Transforms the vertices of the grip, or the selected probes, from their pose in `before`. `degrees_seen`
/// is the rotation of the current pose. If Transform::degrees differs much from `degrees_seen`, rotates in
/// small steps to count whole turns. |degrees| must be at most most_degrees. If the result is out of range
/// (document/range.h), restores the pose of `before` and returns false.
bool place(document::Document& document, const document::DocumentState& before, const Grip& grip,
           const Transform& transform, double degrees_seen);

/// Call this after a rotation from the pose in `before`. Sets the exact whole turns of each part of the cage
/// that rotated rigidly.
void count_whole_turns(document::Document& document, const document::DocumentState& before, const Grip& grip,
                       const Transform& transform);

/// Transforms the selection as an undoable edit. Requires a selection. If the result is out of range, changes
/// nothing and returns false.
bool transform_selection(document::Document& document, Tool tool, const Grip& grip,
                         const Transform& transform);

/// Returns the name of the edit in the history, such as "rotate 3 faces".
std::string edit_label(Tool tool, const document::Selection& selection);

/// Transforms the selected probes from their pose in `before`. If the result is out of range, changes nothing
/// and returns false.
bool place_probes(document::Document& document, const document::DocumentState& before,
                  const Transform& transform);

}  // namespace viete::interact
