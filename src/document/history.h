// Undo and redo.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document/document_state.h"

namespace viete::document {

/// Decides which edits merge with the previous one; labels are only for display.
enum class EditKind { other, selection, binding, amounts, mix, keys, play, probe_radius, cage };

/// Consecutive edits of the same step can merge into one.
struct EditStep {
  EditKind kind = EditKind::other;
  std::size_t of = 0;  ///< instance of the kind: a setting, a pose, a frame

  friend bool operator==(const EditStep&, const EditStep&) = default;
};

/// One entry per finished edit. Each entry is a complete snapshot: cages are small, and snapshots cannot
/// drift. Beyond 256 MB the oldest entries are dropped, selection changes first, so that clicks alone never
/// push out an edit.
class History {
public:
  /// Records the edit `label`; `before` is the state before it.
  void record(std::string label, DocumentState before, EditStep step = {});

  /// Records a change of the selection only. The revision is unchanged, since no work would be lost.
  void record_selection(DocumentState before);
  /// Sets the selection from before the last edit. Requires can_undo().
  void began_with(const Selection& selection) { undo_.back().state.selection = selection; }

  /// The last edit continues: its result changed, but it stays one entry.
  void extend_last() { ++revision_; }
  /// Removes the last edit as if it had never been made: returns the state before it and restores the redo
  /// list of that time. Requires can_undo().
  DocumentState drop_last();
  /// The number of recorded edits, without dropped ones.
  unsigned long recorded() const { return recorded_; }

  /// Call after the file was overwritten with this cage: other cages read from it lose their file name.
  void file_replaced(const std::filesystem::path& file, const std::shared_ptr<const deform::Cage>& by);

  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }
  /// The label of the edit that the next undo reverts; empty: none.
  std::string undo_label() const { return can_undo() ? undo_.back().label : ""; }
  std::string redo_label() const { return can_redo() ? redo_.back().label : ""; }
  /// Labels of all edits, undone ones included, oldest first; position() is the number in effect.
  std::vector<std::string> labels() const;
  std::size_t position() const { return undo_.size(); }
  /// The last edit's step, for merging; nullopt if there is none or the last action was an undo.
  std::optional<EditStep> last_step() const;
  /// The state that the next undo restores; null: none.
  const DocumentState* before_last() const { return can_undo() ? &undo_.back().state : nullptr; }
  /// Increases with each finished, undone or redone edit, except changes of the selection.
  unsigned long revision() const { return revision_; }

  /// Returns the state before the last edit and stores `now` for redo. Requires can_undo().
  DocumentState undo(DocumentState now) { return step(undo_, redo_, std::move(now)); }
  /// The reverse of undo(). Requires can_redo().
  DocumentState redo(DocumentState now) { return step(redo_, undo_, std::move(now)); }

private:
  void push(std::string label, DocumentState before, EditStep step);

  struct Entry {
    std::string label;
    DocumentState state;
    EditStep step;
    unsigned long number;  // running number of the recorded edit

    EditKind kind() const { return step.kind; }
  };
  /// Pops the last entry of `from` and stores `now` in `to`.
  DocumentState step(std::vector<Entry>& from, std::vector<Entry>& to, DocumentState now);

  std::vector<Entry> undo_, redo_;
  std::vector<Entry> given_up_;  // the redo list before the last edit
  unsigned long revision_ = 0, recorded_ = 0;
};

}  // namespace viete::document
