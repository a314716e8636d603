// Records, cancels and undoes edits of a document.
#pragma once

#include <string>

#include "document/document.h"

namespace viete::document {

/// Records the current state for undo. Call this before changing the document.
void record_edit(Document& document, const std::string& label, EditStep step = {});
/// Records an edit by a slider, which makes many small edits: if the last edit has the same step and `merge`
/// is true, extends that edit. Otherwise records a new edit.
void record_step(Document& document, const std::string& label, EditStep step, bool merge = true);

/// The state of a document before an action that can be cancelled.
struct EditMark {
  DocumentState state;
  unsigned long revision, recorded;  ///< see History
};
EditMark mark_of(const Document& document);
/// Restores the marked state and its history.
void take_back(Document& document, EditMark&& mark);

/// True if a cage vertex, a probe or the model's shape changed.
bool moved_since(const Document& document, const DocumentState& before);

/// Requires History::can_undo().
void undo(Document& document);
/// Requires History::can_redo().
void redo(Document& document);
/// Undoes or redoes until History::position() is `edits`.
void go_to_edit(Document& document, std::size_t edits);

/// Records a change of the selection that was already made. `before` is the previous selection. Does nothing
/// if both selections are empty.
void record_selection(Document& document, const Selection& before);

}  // namespace viete::document
