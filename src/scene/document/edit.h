// Edits of a document: each is one entry of its history, or a setting.
#pragma once

#include <span>
#include <string>

#include "scene/document/document.h"
#include "scene/document/mirror.h"
#include "scene/document/record.h"

namespace viete::scene {

/// True if the model has a shape, or some cage vertex or a probe that is not locked is not at rest, or is
/// there after whole turns.
bool differs_from_rest(const Document& document);

/// All vertices, or the selected ones, back to rest. Undoable.
void reset_pose(Document& document);
void reset_selected(Document& document, const Mirror* mirror = nullptr);

/// What of the cage is selected and moved: the selection becomes the elements of this kind whose vertices it
/// all holds. An edit like any of the selection.
void select_kind(Document& document, ElementKind kind);

/// How the cage moves the model. Undoable; radii that are chosen one after the other are one edit, amounts
/// too.
void set_scheme(Document& document, const deform::Scheme& scheme);
/// deform::least_radius to largest_radius. Of weights that have none it is kept for others.
void set_radius(Document& document, double radius);
/// Each 0 to deform::largest_amount.
void set_amounts(Document& document, const deform::Amounts& amounts);
/// How often a stitched model is solved for, 1 to deform::most_iterations, or 0: not stitched. Undoable;
/// numbers that are chosen one after the other are one edit. Requires elements that turn and stretch, or 0.
void set_iterations(Document& document, int iterations);
/// What holds a stitched model. Undoable; the same.
void set_holding(Document& document, const deform::Holding& holding);
/// They are not to be had: the last one that was chosen counts as never chosen, or these are put in its
/// place.
void give_up_scheme(Document& document, const deform::Scheme& instead);

}  // namespace viete::scene
