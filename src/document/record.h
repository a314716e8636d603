// Beginning, ending and undoing edits of a document.
#pragma once

#include <string>

#include "document/document.h"

namespace viete::document {

/// Begins an edit: undo restores the current state.
void record_edit(Document& document, const std::string& label, EditStep step = {});
/// As record_edit() for edits in small steps, as by a slider: consecutive equal steps merge into one edit
/// while `merge` is true.
void record_step(Document& document, const std::string& label, EditStep step, bool merge = true);

/// A saved state of a document, for an action that can be cancelled.
struct EditMark {
  DocumentState state;
  unsigned long revision, recorded;  ///< revisions of the history
};
EditMark mark_of(const Document& document);
/// Restores that state bit for bit, including the history.
void take_back(Document& document, EditMark&& mark);

/// True if a vertex or a probe moved or the model's shape changed.
bool moved_since(const Document& document, const DocumentState& before);

/// Require can_undo() and can_redo() of the history.
void undo(Document& document);
void redo(Document& document);
/// Undoes or redoes until so many edits are in effect.
void go_to_edit(Document& document, std::size_t edits);

/// Records a selection that was already changed as an edit: undo restores `before`. Two empty selections
/// record nothing.
void record_selection(Document& document, const Selection& before);

}  // namespace viete::document
