// Records, cancels and undoes edits of a document.
#pragma once

#include <string>

#include "document/document.h"

namespace viete::document {

/// Records the current state for undo. Call this before each change of the document.
void record_edit(Document& document, const std::string& label, EditStep step = {});
/// Records one of the many small edits by a slider. If the last edit has an equal step and `merge` is true,
/// the edit becomes part of the last edit. Otherwise, it is a new edit.
void record_step(Document& document, const std::string& label, EditStep step, bool merge = true);

/// The state of a document before an action that the user can cancel.
struct EditMark {
  DocumentState state;
  unsigned long revision, recorded;  ///< see History
};
EditMark mark_of(const Document& document);
/// Restores the state and the history of the mark.
void take_back(Document& document, EditMark&& mark);

/// True if a cage vertex, a probe or the model's shape differs from the state `before`.
bool moved_since(const Document& document, const DocumentState& before);

/// Undoes the last edit. Requires History::can_undo().
void undo(Document& document);
/// Redoes the next edit. Requires History::can_redo().
void redo(Document& document);
/// Undoes or redoes edits until History::position() equals `edits`.
void go_to_edit(Document& document, std::size_t edits);

/// Records a change of the selection after it was made. `before` is the previous selection. If the selections
/// are equal or both are empty, does nothing.
void record_selection(Document& document, const Selection& before);

}  // namespace viete::document
