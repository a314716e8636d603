#include "document/record.h"

#include <utility>

namespace viete::document {

void record_edit(Document& document, const std::string& label, EditStep step) {
  document.changed_history().record(label, document.state(), step);
}

void record_step(Document& document, const std::string& label, EditStep step, bool merge) {
  if (!merge || document.history().last_step() != step) return record_edit(document, label, step);
  document.changed_history().extend_last();
}

EditMark mark_of(const Document& document) {
  return {document.state(), document.history().revision(), document.history().recorded()};
}

void take_back(Document& document, EditMark&& mark) {
  if (document.history().revision() == mark.revision) return;
  while (document.history().recorded() > mark.recorded && document.history().can_undo())
    (void)document.changed_history().drop_last();
  document.restore(std::move(mark.state));
}

bool moved_since(const Document& document, const DocumentState& before) {
  return document.pose().positions != before.pose.positions || document.probes() != before.probes ||
         !same_shape(document.shape(), before.shape);
}

void undo(Document& document) {
  document.restore(document.changed_history().undo(document.state()));
}

void redo(Document& document) {
  document.restore(document.changed_history().redo(document.state()));
}

void go_to_edit(Document& document, std::size_t edits) {
  const History& history = document.history();
  while (history.position() > edits && history.can_undo()) undo(document);
  while (history.position() < edits && history.can_redo()) redo(document);
}

void record_selection(Document& document, const Selection& before) {
  if (before == document.selection() || (before.empty() && document.selection().empty())) return;
  DocumentState state = document.state();
  state.selection = before;
  document.changed_history().record_selection(std::move(state));
}

}  // namespace viete::document
