// The history of a document: undo and redo.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document/document_state.h"

namespace viete::document {

enum class EditKind { other, selection, binding, amounts, mix, keys, play, probe_radius, cage };

/// Identifies what an edit changes. If consecutive edits have equal steps, they can merge into one edit.
struct EditStep {
  EditKind kind = EditKind::other;
  std::size_t of = 0;  ///< the index of the edited setting, pose or probe part

  friend bool operator==(const EditStep&, const EditStep&) = default;
};

/// The undo and redo lists. An undo entry has the complete state of the document before the edit. If there
/// are more than 16 entries and they need more than 256 MB, drops the oldest change of the selection. If
/// there is no such change, drops the oldest edit.
class History {
public:
  /// Adds an edit. `before` is the state before the edit.
  void record(std::string label, DocumentState before, EditStep step = {});

  /// Adds a change of the selection. Keeps the revision, because a selection need not be saved.
  void record_selection(DocumentState before);
  /// Replaces the selection in the state that the next undo restores. Requires can_undo().
  void began_with(const Selection& selection) { undo_.back().state.selection = selection; }

  /// Increases the revision. Call this after a change that belongs to the last edit.
  void extend_last() { ++revision_; }
  /// Removes the last edit, restores the redo list, and returns the state before the edit. Requires
  /// can_undo().
  DocumentState drop_last();
  /// Returns the number of recorded edits. drop_last() decreases it by one.
  unsigned long recorded() const { return recorded_; }

  /// Call this after saving the cage `by` to `file`. Removes this path from all other cages of the history.
  void file_replaced(const std::filesystem::path& file, const std::shared_ptr<const pose::Cage>& by);

  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }
  /// Returns the label of the edit that the next undo reverts; empty without such an edit.
  std::string undo_label() const { return can_undo() ? undo_.back().label : ""; }
  std::string redo_label() const { return can_redo() ? redo_.back().label : ""; }
  /// Returns the labels of the undo list and of the redo list, in the order in which the edits were made.
  std::vector<std::string> labels() const;
  /// Returns the length of the undo list.
  std::size_t position() const { return undo_.size(); }
  /// Returns the step of the last edit. If there is no edit or the redo list is not empty, returns nullopt.
  std::optional<EditStep> last_step() const;
  /// Returns the state that the next undo restores; null without such a state.
  const DocumentState* before_last() const { return can_undo() ? &undo_.back().state : nullptr; }
  /// Changes with each edit, undo and redo, but not when a change of the selection is recorded.
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

    EditKind kind() const { return step.kind; }
  };
  /// Undoes or redoes: removes the last entry of `from` and returns its state. Stores `now` in `to`.
  DocumentState step(std::vector<Entry>& from, std::vector<Entry>& to, DocumentState now);

  std::vector<Entry> undo_, redo_;
  std::vector<Entry> given_up_;  // the redo list that the last edit cleared
  unsigned long revision_ = 0, recorded_ = 0;
};

}  // namespace viete::document
