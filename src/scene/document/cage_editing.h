// Editing the cage itself instead of posing it: a mode that shows the cage at rest.
#pragma once

#include "scene/document/document.h"

namespace viete::scene {

/// Margin between a fitted cage and its box, relative to the model's diagonal.
inline constexpr double fit_margin = 0.01;

/// Enter and leave the mode. On leaving, remaining vertices get their pose back, shifted by the edit of their
/// rest positions. Undoable. Require a cage.
void begin_cage_editing(Document& document);
void end_cage_editing(Document& document);

/// In cage editing: makes moved positions the cage's rest shape, as part of the edit that moved them. Returns
/// true if any moved. If the result is no valid cage, undoes that edit and throws base::Error.
bool commit_cage_edit(Document& document);

/// Edit the selected elements, one edit each. Require the mode and a selection; those that change the whole
/// cage work in any mode. Throw base::Error without a change if the result would be no valid cage.
void split_selected(Document& document);    ///< edges
void cut_selected(Document& document);      ///< faces
void merge_selected(Document& document);    ///< vertices
void remove_selected(Document& document);   ///< vertices, edges: dissolved; faces: deleted
void extrude_selected(Document& document);  ///< faces
void subdivide_cage(Document& document);
/// Mirrors the larger side across the axis-aligned plane in which the model is most symmetric.
void mirror_cage(Document& document);
/// Moves and scales the cage, and its pose, to the model's box.
void fit_cage(Document& document);
/// As fit_cage(), and also rotates the cage if that fits better. Returns the rotation in degrees.
double fit_cage_turned(Document& document);
/// Moves the cage outward where it does not contain model vertices. Returns how many remain outside.
std::size_t enclose_model(Document& document);

/// Vertices moved outside, and vertices left inside because no short path leads out.
struct SnapResult {
  std::size_t moved = 0, left = 0;
};
/// Moves selected cage vertices that are inside or almost inside the model out of it.
SnapResult snap_selected(Document& document);

}  // namespace viete::scene
