// Changing the cage itself instead of posing it: a mode in which the cage is shown at rest.
#pragma once

#include "scene/document/document.h"

namespace viete::scene {

/// Of the model's diagonal, that a fitted cage keeps from its box.
inline constexpr double fit_margin = 0.01;

/// Into the mode, and out of it: vertices that remained have their pose again, moved as they were at rest.
/// Undoable. Require a cage.
void begin_cage_editing(Document& document);
void end_cage_editing(Document& document);

/// In that mode: what a hand or a field has moved becomes the rest of the cage. Part of the edit that moved
/// it. Throws base::Error, and takes that edit back, if it is no cage then. Says whether there was anything.
bool settle_cage_edit(Document& document);

/// Changes of what is selected, each one edit. Throw base::Error, and change nothing, where the result is no
/// cage. Require the mode and a selection, but for those that take all of the cage, in any mode.
void split_selected(Document& document);    ///< edges
void cut_selected(Document& document);      ///< faces
void merge_selected(Document& document);    ///< vertices
void remove_selected(Document& document);   ///< vertices, edges: dissolved; faces: gone
void extrude_selected(Document& document);  ///< faces
void subdivide_cage(Document& document);
/// About the plane across the axis in which the model is most symmetric; what is on its larger side counts.
void mirror_cage(Document& document);
/// The cage is moved and scaled to the model's box. The pose is too, here and in the next.
void fit_cage(Document& document);
/// It is turned too, where that brings it nearer. Returns by how many degrees.
double fit_cage_turned(Document& document);
/// Moved outward where vertices of the model are outside. Returns how many still are.
std::size_t enclose_model(Document& document);

/// Vertices that were moved, and those that no short way brings out.
struct SnapResult {
  std::size_t moved = 0, left = 0;
};
/// Selected vertices of the cage that are within the model, or nearly, are moved out of it.
SnapResult snap_selected(Document& document);

}  // namespace viete::scene
