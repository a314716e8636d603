// Editing the cage itself instead of posing it: a mode that shows the cage at rest.
#pragma once

#include "document/document.h"

namespace viete::document {

/// Margin between a fitted cage and its box, relative to the model's diagonal.
inline constexpr double fit_margin = 0.01;

/// Begin and end cage editing. At the end, remaining vertices get their pose back, shifted by the edit of
/// their rest positions. Undoable. Require a cage.
void begin_cage_editing(Document& document);
void end_cage_editing(Document& document);

/// Makes positions moved in cage editing the cage's rest shape, as part of the edit that moved them. Returns
/// true if any moved. If the result is not a valid cage, undoes that edit and throws base::Error.
bool commit_cage_edit(Document& document);

/// Edit the selected elements, one edit each. Require the mode and a selection; those that change the whole
/// cage work in any mode. Throw base::Error without a change if the result would not be a valid cage.
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
/// Moves the cage outward where it does not contain model vertices. Returns how many remain outside.
std::size_t enclose_model(Document& document);

}  // namespace viete::document
