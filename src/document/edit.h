// Edits of a document: each is one history entry, or a setting.
#pragma once

#include "document/document.h"
#include "document/mirror.h"
#include "document/record.h"

namespace viete::document {

/// True if the model has a shape, or a cage vertex or an unlocked probe is not at rest or has whole turns.
bool differs_from_rest(const Document& document);

/// Resets all vertices, or the selected ones, to rest. Undoable.
void reset_pose(Document& document);
void reset_selected(Document& document, const Mirror* mirror = nullptr);

/// Sets the kind of elements to select and move, and selects the elements of this kind whose vertices are all
/// selected. Recorded like any change of the selection.
void select_kind(Document& document, ElementKind kind);

/// Sets the deformer. Undoable; consecutive changes of the radius are one edit, and so are those of the
/// amounts.
void set_scheme(Document& document, const deform::Scheme& scheme);
/// Sets the radius, even if the current weights do not use it.
void set_radius(Document& document, double radius);
void set_amounts(Document& document, const deform::Amounts& amounts);
/// Iterations of the stitched solve, 1 to deform::most_iterations, or 0: not stitched. Undoable; consecutive
/// changes are one edit. Requires elements that turn and stretch, or 0.
void set_iterations(Document& document, int iterations);
/// Sets the constraints of a stitched model. Undoable; consecutive changes are one edit.
void set_holding(Document& document, const deform::Holding& holding);
/// For settings that failed: undoes the last change of the scheme, or replaces the scheme by `instead`.
void revert_scheme(Document& document, const deform::Scheme& instead);

}  // namespace viete::document
