// Cage editing: a mode that shows the cage at rest. In this mode, dragging changes the rest shape.
#pragma once

#include "document/document.h"

namespace viete::document {

/// The margin that fit_cage() leaves around the model's box, relative to the model's diagonal.
inline constexpr double fit_margin = 0.01;

/// Begin and end cage editing. At the end, the cage returns to its pose. If editing moved the rest position
/// of a vertex, the vertex has moved equally in the pose. Undoable. Both functions require a cage.
void begin_cage_editing(Document& document);
void end_cage_editing(Document& document);

/// True if an edit has moved vertices during cage editing, so that commit_cage_edit() has something to do.
bool has_moved_rest(const Document& document);
/// Call this after an edit that moved vertices. Makes the moved positions the cage's rest shape, as part of
/// this edit. If no vertex moved, or outside cage editing, does nothing and returns false. If the new cage is
/// invalid, undoes the edit and throws base::Error.
bool commit_cage_edit(Document& document);

/// Each function below is one undoable edit. If the selection is unsuitable or the new cage would be invalid,
/// it changes nothing and throws base::Error. Functions with `selected` in the name require cage editing.
void split_selected(Document& document);    ///< splits edges
void cut_selected(Document& document);      ///< cuts faces
void merge_selected(Document& document);    ///< merges vertices
void remove_selected(Document& document);   ///< dissolves vertices or edges, or deletes faces
void extrude_selected(Document& document);  ///< extrudes faces
void subdivide_cage(Document& document);
/// Mirrors one half of the cage across an axis-aligned plane: the plane in which the model is most symmetric.
/// Keeps the half with the selected vertices or, without a selection, the positive half.
void mirror_cage(Document& document);
/// Fits the cage to the model's bounding box. Moves and scales the rest shape and the pose.
void fit_cage(Document& document);
/// Moves the cage outward to enclose the model. Returns the number of model vertices that are still outside.
std::size_t enclose_model(Document& document);

}  // namespace viete::document
