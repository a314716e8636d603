// Undo and redo.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/document/document_state.h"

namespace viete::scene {

/// What an edit is, as far as that decides what becomes of the next one: labels are for people alone.
enum class EditKind { other, selection, binding, amounts, mix, keys, play, probe_radius, cage };

/// Edits of the same step that follow one another can be one edit.
struct EditStep {
  EditKind kind = EditKind::other;
  std::size_t of = 0;  ///< which one of the kind: a setting, a pose, a frame

  friend bool operator==(const EditStep&, const EditStep&) = default;
};

/// One entry per finished edit. Snapshots are whole: a cage is small, and a snapshot cannot drift. Beyond
/// 256 MB the oldest entries are dropped, those of the selection alone first: no number of clicks takes an
/// edit out of reach.
class History {
public:
  /// An edit named `label` has just led away from `before`.
  void record(std::string label, DocumentState before, EditStep step = {});

  /// Likewise one that has changed the selection alone, which is no work that could be lost: the revision
  /// stays.
  void record_selection(DocumentState before);
  /// What was selected before the last edit, if that has changed it. Requires can_undo().
  void began_with(const Selection& selection) { undo_.back().state.selection = selection; }

  /// What the last edit has left went on to change: it is still one entry.
  void go_on() { ++revision_; }
  /// As if the last edit had not been made: gives the state before it, and what could be repeated then can be
  /// again. Requires can_undo().
  DocumentState drop_last();
  /// Edits that were recorded, those that were dropped since not counted.
  unsigned long recorded() const { return recorded_; }
  /// The label of the oldest edit since so many were recorded, or "undo ..." if earlier ones were taken back;
  /// empty if there is neither. Those of the selection alone do not count.
  std::string first_edit_since(unsigned long recorded) const;

  /// The file now holds this cage: others that states have from it are in no file any more.
  void file_replaced(const std::filesystem::path& file, const std::shared_ptr<const deform::Cage>& by);

  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }
  /// What the next undo would take back; empty if nothing.
  std::string undo_label() const { return can_undo() ? undo_.back().label : ""; }
  std::string redo_label() const { return can_redo() ? redo_.back().label : ""; }
  /// Labels of all edits, undone ones included, oldest first; and how many are in force.
  std::vector<std::string> labels() const;
  std::size_t position() const { return undo_.size(); }
  /// The last edit, which another one may go on with; nothing where there is none, or some were taken back.
  std::optional<EditStep> last_step() const;
  /// What the next undo would lead back to; null if nothing.
  const DocumentState* before_last() const { return can_undo() ? &undo_.back().state : nullptr; }
  /// Grows with each edit that is finished, taken back or repeated; changes of the selection apart.
  unsigned long revision() const { return revision_; }

  /// Gives the state before the last edit and keeps `now` for redo. Requires can_undo().
  DocumentState undo(DocumentState now) { return step(undo_, redo_, std::move(now)); }
  /// The reverse. Requires can_redo().
  DocumentState redo(DocumentState now) { return step(redo_, undo_, std::move(now)); }

private:
  void push(std::string label, DocumentState before, EditStep step);
  void drop_oldest();

  struct Entry {
    std::string label;
    DocumentState state;
    EditStep step;
    unsigned long number;  // of those that were recorded

    bool of_selection() const { return step.kind == EditKind::selection; }  // alone
  };
  /// The last one of `from` is given, and `now` is kept in the other.
  DocumentState step(std::vector<Entry>& from, std::vector<Entry>& to, DocumentState now);

  std::vector<Entry> undo_, redo_;
  std::vector<Entry> given_up_;  // what could be repeated before the last edit
  unsigned long revision_ = 0, recorded_ = 0;
};

}  // namespace viete::scene
