// Edits of a document: each is one entry of its history, or a setting.
#pragma once

#include "scene/document.h"

namespace viete::scene {

/// True if some cage vertex is not at rest, or is there after whole turns.
bool differs_from_rest(const Document& document);

/// All vertices, or the selected ones, back to rest. Undoable.
void reset_pose(Document& document);
void reset_selected(Document& document);

/// What of the cage is selected and moved: the selection becomes the elements of this kind whose vertices it
/// all holds.
void select_kind(Document& document, ElementKind kind);

/// Require can_undo() and can_redo() of the history.
void undo(Document& document);
void redo(Document& document);

/// Settings: the frame is computed anew, the pose is untouched, the history too.
void set_method(Document& document, sym3::Method method);
void set_coordinates(Document& document, deform::Coordinates coordinates);
/// deform::lowest_reach or more.
void set_reach(Document& document, double reach);

}  // namespace viete::scene
