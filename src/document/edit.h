// Edits of a document: reset the pose, and change the deformer's settings.
#pragma once

#include "document/document.h"
#include "document/mirror.h"

namespace viete::document {

/// True if the shape, a cage vertex or an unlocked probe is not at rest, or if the cage has whole turns.
bool differs_from_rest(const Document& document);

/// Resets the model's shape, the cage and all unlocked probes to rest, and all weights to 0. Undoable.
void reset_pose(Document& document);
/// Resets the selected elements to rest. If there is a mirror, also resets their mirror partners. Undoable.
void reset_selected(Document& document, const Mirror* mirror = nullptr);

/// Sets the kind of elements that the user selects. Selects the elements of this kind whose vertices were all
/// selected. If the old or the new kind is `probe`, clears the selection. Undoable.
void select_kind(Document& document, ElementKind kind);

void set_deformer(Document& document, const pose::Deformer& deformer);

/// Set one setting of the deformer. Undoable. Consecutive changes of one setting form one edit.
void set_radius(Document& document, double radius);
void set_amounts(Document& document, const pose::Amounts& amounts);
/// Sets Deformer::iterations, at most pose::most_iterations. 0 turns ARAP off. ARAP requires a
/// deformer with Deformer::has_maps().
void set_iterations(Document& document, int iterations);
void set_holding(Document& document, const pose::Holding& holding);
/// Sets the deformer to `instead` after binding failed. If the last edit changed the deformer, removes the
/// edit.
void revert_deformer(Document& document, const pose::Deformer& instead);

}  // namespace viete::document
