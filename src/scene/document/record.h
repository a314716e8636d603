// Edits of a document begin and end: what undo leads back to.
#pragma once

#include <string>

#include "scene/document/document.h"

namespace viete::scene {

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
