// Edits of a document: resetting the pose, and changing the deformer's settings.
#pragma once

#include "document/document.h"
#include "document/mirror.h"
#include "document/record.h"

namespace viete::document {

/// True if the model's shape, a cage vertex or an unlocked probe is not at rest, or the cage has whole turns.
bool differs_from_rest(const Document& document);

/// Resets the model's shape, the cage and all unlocked probes to rest. Undoable.
void reset_pose(Document& document);
/// Resets the selected elements to rest; with a mirror, also their mirror partners. Undoable.
void reset_selected(Document& document, const Mirror* mirror = nullptr);

/// Sets the kind of elements that the user selects. Selects the elements of this kind whose vertices are all
/// selected. Undoable.
void select_kind(Document& document, ElementKind kind);

/// Sets the deformer. Undoable.
void set_scheme(Document& document, const deform::Scheme& scheme);

/// Set one setting of the deformer. Undoable; consecutive changes of the same setting are one edit.
void set_radius(Document& document, double radius);
void set_amounts(Document& document, const deform::Amounts& amounts);
/// Sets the number of iterations of stitching, at most deform::most_iterations. 0 turns stitching off; other
/// values require elements that rotate and stretch.
void set_iterations(Document& document, int iterations);
void set_holding(Document& document, const deform::Holding& holding);
/// After binding failed, sets the scheme to `instead`. Removes the last edit if it changed the scheme.
void revert_scheme(Document& document, const deform::Scheme& instead);

}  // namespace viete::document
