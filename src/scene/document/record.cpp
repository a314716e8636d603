#include "scene/document/record.h"

#include <utility>

namespace viete::scene {

namespace {

void restore(Document& document, DocumentState&& state) {
  if (document.cage != state.cage) ++document.revisions.cage;
  const deform::Scheme scheme = std::exchange(state.scheme, document.scheme);
  static_cast<DocumentState&>(document) = std::move(state);
  ++document.revisions.pose;
  document.carried.clear();
  put_scheme(document, scheme);
}

}  // namespace

void record_edit(Document& document, const std::string& label) {
  document.history.record(label, state_of(document));
}

void record_step(Document& document, const std::string& label) {
  if (document.history.undo_label() == label && !document.history.can_redo()) {
    document.history.go_on();
  } else {
    record_edit(document, label);
  }
}

EditMark mark_of(const Document& document) {
  return {state_of(document), document.history.revision(), document.history.recorded()};
}

void take_back(Document& document, EditMark&& mark) {
  if (document.history.revision() == mark.revision) return;
  while (document.history.recorded() > mark.recorded && document.history.can_undo())
    (void)document.history.drop_last();
  restore(document, std::move(mark.state));
}

void put_scheme(Document& document, const deform::Scheme& scheme) {
  const deform::Scheme old = std::exchange(document.scheme, scheme);
  if (old.weighting != scheme.weighting) ++document.revisions.weights;
  if (old.blend != scheme.blend || old.weighting.elements != scheme.weighting.elements ||
      old.amounts != scheme.amounts || old.iterations != scheme.iterations || old.holding != scheme.holding)
    ++document.revisions.method;
}

bool moved_since(const Document& document, const DocumentState& before) {
  return document.pose.positions != before.pose.positions || document.probes != before.probes;
}

void undo(Document& document) {
  restore(document, document.history.undo(state_of(document)));
}

void redo(Document& document) {
  restore(document, document.history.redo(state_of(document)));
}

void record_selection(Document& document, const Selection& before) {
  if (before == document.selection || (before.empty() && document.selection.empty())) return;
  DocumentState state = state_of(document);
  state.selection = before;
  document.history.record_selection(std::move(state));
}

}  // namespace viete::scene
