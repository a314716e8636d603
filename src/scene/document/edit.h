// Edits of a document: each is one entry of its history, or a setting.
#pragma once

#include <span>
#include <string>

#include "scene/document/document.h"
#include "scene/document/mirror.h"

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

/// An edit begins: what is there now is what undo leads back to.
void record_edit(Document& document, const std::string& label, EditStep step = {});
/// The same for one that is made in small steps, as by a slider: the same ones that follow one another are
/// one edit, as long as that `goes_on`.
void record_step(Document& document, const std::string& label, EditStep step, bool goes_on = true);

/// A document as it is before something that may be called off.
struct EditMark {
  DocumentState state;
  unsigned long revision, recorded;  ///< of the history
};
EditMark mark_of(const Document& document);
/// As it was then, to the last bit: what was recorded since never was.
void take_back(Document& document, EditMark&& mark);

/// True if a vertex or a probe is not where it was, or the model has another shape.
bool moved_since(const Document& document, const DocumentState& before);

/// Require can_undo() and can_redo() of the history.
void undo(Document& document);
void redo(Document& document);
/// To after the first so many of the edits that the history has.
void go_to_edit(Document& document, std::size_t edits);

/// Another selection is there already, as an edit: `before` is what undo leads back to. Where nothing is
/// selected before and after there is nothing to take back.
void record_selection(Document& document, const Selection& before);

}  // namespace viete::scene
