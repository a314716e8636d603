#include "document/record.h"

#include <utility>

namespace viete::document {

void record_edit(Document& document, const std::string& label, EditStep step) {
  document.history.record(label, state_of(document), step);
}

void record_step(Document& document, const std::string& label, EditStep step, bool merge) {
  if (!merge || document.history.last_step() != step) return record_edit(document, label, step);
  document.history.extend_last();
}

EditMark mark_of(const Document& document) {
  return {state_of(document), document.history.revision(), document.history.recorded()};
}

void take_back(Document& document, EditMark&& mark) {
  if (document.history.revision() == mark.revision) return;
  while (document.history.recorded() > mark.recorded && document.history.can_undo())
    (void)document.history.drop_last();
  document.restore(std::move(mark.state));
}

bool moved_since(const Document& document, const DocumentState& before) {
  return document.pose.positions != before.pose.positions || document.probes != before.probes ||
         !same_shape(document.shape, before.shape);
}

void undo(Document& document) {
  document.restore(document.history.undo(state_of(document)));
}

void redo(Document& document) {
  document.restore(document.history.redo(state_of(document)));
}

void go_to_edit(Document& document, std::size_t edits) {
  const History& history = document.history;
  while (history.position() > edits && history.can_undo()) undo(document);
  while (history.position() < edits && history.can_redo()) redo(document);
}

void record_selection(Document& document, const Selection& before) {
  if (before == document.selection || (before.empty() && document.selection.empty())) return;
  DocumentState state = state_of(document);
  state.selection = before;
  document.history.record_selection(std::move(state));
}

}  // namespace viete::document
