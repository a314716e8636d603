// Undo and redo.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document/document_state.h"

namespace viete::document {

enum class EditKind { other, selection, binding, amounts, mix, keys, play, probe_radius, cage };

/// Consecutive edits with equal steps can merge into one edit.
struct EditStep {
  EditKind kind = EditKind::other;
  std::size_t of = 0;  ///< the index of the edited setting, pose or probe part

  friend bool operator==(const EditStep&, const EditStep&) = default;
};

/// The undo and redo lists. Each entry stores the complete state of the document before an edit. Above 256
/// MB, the oldest entries are dropped, but changes of the selection are dropped before all other edits.
class History {
public:
  /// Adds an edit. `before` is the state before the edit.
  void record(std::string label, DocumentState before, EditStep step = {});

  /// Adds a change of the selection. Does not increase the revision: a selection need not be saved.
  void record_selection(DocumentState before);
  /// Replaces the selection stored with the last edit. Requires can_undo().
  void began_with(const Selection& selection) { undo_.back().state.selection = selection; }

  /// Increases the revision: the last edit now includes the latest change.
  void extend_last() { ++revision_; }
  /// Removes the last edit and restores the redo list from before the edit. Returns the state before the
  /// edit. Requires can_undo().
  DocumentState drop_last();
  /// Returns the number of recorded edits. drop_last() decreases this number.
  unsigned long recorded() const { return recorded_; }

  /// Call this after the file was overwritten with the cage `by`. Other cages from this file lose their path.
  void file_replaced(const std::filesystem::path& file, const std::shared_ptr<const deform::Cage>& by);

  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }
  /// Returns the label of the edit that the next undo reverts; empty if there is no such edit.
  std::string undo_label() const { return can_undo() ? undo_.back().label : ""; }
  std::string redo_label() const { return can_redo() ? redo_.back().label : ""; }
  /// Returns the labels of the undo list, then of the redo list, in the order in which the edits were made.
  std::vector<std::string> labels() const;
  /// Returns the length of the undo list.
  std::size_t position() const { return undo_.size(); }
  /// Returns the step of the last edit; nullopt without an edit or if the redo list is not empty.
  std::optional<EditStep> last_step() const;
  /// Returns the state that the next undo restores; null if there is no edit to undo.
  const DocumentState* before_last() const { return can_undo() ? &undo_.back().state : nullptr; }
  /// Increases with each edit, undo and redo, but not with changes of the selection.
  unsigned long revision() const { return revision_; }

  /// Returns the state before the last edit, and stores `now` for redo. Requires can_undo().
  DocumentState undo(DocumentState now) { return step(undo_, redo_, std::move(now)); }
  /// Returns the state after the next edit, and stores `now` for undo. Requires can_redo().
  DocumentState redo(DocumentState now) { return step(redo_, undo_, std::move(now)); }

private:
  void push(std::string label, DocumentState before, EditStep step);

  struct Entry {
    std::string label;
    DocumentState state;
    EditStep step;
    unsigned long number;

    EditKind kind() const { return step.kind; }
  };
  /// Removes the last entry of `from` and returns its state. Stores `now` in `to`.
  DocumentState step(std::vector<Entry>& from, std::vector<Entry>& to, DocumentState now);

  std::vector<Entry> undo_, redo_;
  std::vector<Entry> given_up_;  // the redo list before the last edit
  unsigned long revision_ = 0, recorded_ = 0;
};

}  // namespace viete::document
