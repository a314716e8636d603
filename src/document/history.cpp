#include "document/history.h"

#include <algorithm>
#include <utility>

namespace viete::document {

void History::record(std::string label, DocumentState before, EditStep step) {
  ++revision_;
  push(std::move(label), std::move(before), step);
}

void History::record_selection(DocumentState before) {
  push("select", std::move(before), {EditKind::selection});
}

void History::push(std::string label, DocumentState before, EditStep step) {
  constexpr std::size_t memory_limit = 256u << 20;
  constexpr std::size_t bytes_of_cage_vertex = 1000;  // the memory of a cage per vertex, estimated
  const bool other_cage = before.cage && (undo_.empty() || undo_.back().state.cage != before.cage);
  // States with different cages do not share poses and keys. In this case, adds the memory of poses and keys.
  const std::size_t poses =
      before.library.poses.size() + before.timeline.keys.size() + before.timeline.unkeyed.size();
  const std::size_t bytes_of_vertex = bytes_of_cage_vertex + poses * sizeof(mesh::Point);
  const bool other_shape = before.shape && (undo_.empty() || undo_.back().state.shape != before.shape);
  const std::size_t bytes = 512 + (other_shape ? before.shape->size() * sizeof(mesh::Point) : 0) +
                            (other_cage ? bytes_of_vertex * before.pose.positions.size() : 0) +
                            before.pose.positions.size() * (sizeof(mesh::Point) + sizeof(std::uint32_t)) +
                            (before.mask ? before.mask->size() * sizeof(float) : 0);
  const std::size_t limit = std::max<std::size_t>(16, memory_limit / bytes);
  given_up_ = std::exchange(redo_, {});
  ++recorded_;
  if (undo_.size() >= limit) {
    const auto selection = std::ranges::find(undo_, EditKind::selection, &Entry::kind);
    undo_.erase(selection == undo_.end() ? undo_.begin() : selection);
  }
  undo_.push_back({std::move(label), std::move(before), step});
}

void History::file_replaced(const std::filesystem::path& file, const std::shared_ptr<const pose::Cage>& by) {
  for (auto* entries : {&undo_, &redo_, &given_up_})
    for (Entry& entry : *entries) {
      if (entry.state.cage_file.path != file || entry.state.cage == by) continue;
      entry.state.cage_file.made = name_of(entry.state.cage_file) + ", before it was replaced";
      entry.state.cage_file.path.clear();
    }
}

std::optional<EditStep> History::last_step() const {
  return can_undo() && !can_redo() ? std::optional(undo_.back().step) : std::nullopt;
}

std::vector<std::string> History::labels() const {
  std::vector<std::string> all;
  for (const Entry& entry : undo_) all.push_back(entry.label);
  std::for_each(redo_.rbegin(), redo_.rend(), [&](const Entry& entry) { all.push_back(entry.label); });
  return all;
}

DocumentState History::drop_last() {
  ++revision_;
  --recorded_;
  if (redo_.empty()) redo_ = std::exchange(given_up_, {});
  DocumentState before = std::move(undo_.back().state);
  undo_.pop_back();
  return before;
}

DocumentState History::step(std::vector<Entry>& from, std::vector<Entry>& to, DocumentState now) {
  ++revision_;
  Entry entry = std::move(from.back());
  from.pop_back();
  to.push_back({entry.label, std::move(now), entry.step});
  return std::move(entry.state);
}

}  // namespace viete::document
