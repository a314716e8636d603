// The selection: a set of cage elements of one kind. It can be hidden and kept by name: each such change
// is an edit that can be undone.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace viete::scene {

struct Document;

enum class SelectMode { replace, add, remove };

/// Vertices and edges of the cage (Cage::edges), its polygons, and probes.
enum class ElementKind { vertex, edge, face, probe };

/// Indices of elements of kind(), ascending, each once. Which vertices they are: selected_vertices() in
/// scene/document/elements.h.
class Selection {
public:
  Selection() = default;
  /// picked must be ascending.
  explicit Selection(ElementKind kind, std::span<const std::uint32_t> picked = {}) : kind_(kind) {
    apply(picked, SelectMode::replace);
  }

  ElementKind kind() const { return kind_; }
  const std::vector<std::uint32_t>& indices() const { return indices_; }
  bool empty() const { return indices_.empty(); }
  std::size_t size() const { return indices_.size(); }
  bool contains(std::uint32_t index) const;
  /// The one that was picked alone last, as long as it is selected.
  std::optional<std::uint32_t> active() const;

  void clear() { indices_.clear(); }
  void select_all(std::size_t count);
  void invert(std::size_t count);
  /// picked must be ascending.
  void apply(std::span<const std::uint32_t> picked, SelectMode mode);

  /// Whichever was picked last.
  friend bool operator==(const Selection& a, const Selection& b) {
    return a.kind_ == b.kind_ && a.indices_ == b.indices_;
  }

private:
  ElementKind kind_ = ElementKind::vertex;
  std::vector<std::uint32_t> indices_;
  std::uint32_t picked_ = 0;
  bool has_picked_ = false;
};

/// What was selected once, to be selected again: elements of this kind with all their vertices among these.
struct NamedSet {
  std::string name;
  ElementKind kind = ElementKind::vertex;  ///< no probes
  std::vector<std::uint32_t> vertices;     ///< ascending, each once

  friend bool operator==(const NamedSet&, const NamedSet&) = default;
};

struct CageGroups {
  /// Vertices, ascending, each once: elements without any other one are neither shown nor selected, and none
  /// of these is moved by hand.
  std::vector<std::uint32_t> hidden;
  std::vector<NamedSet> sets;

  friend bool operator==(const CageGroups&, const CageGroups&) = default;
};

/// Of the elements of a kind, 1 for those that are hidden; of probes none is.
std::vector<std::uint8_t> hidden_elements(const Document& document, ElementKind kind);
/// Without what is hidden.
Selection without_hidden(const Document& document, Selection selection);
std::vector<std::uint32_t> without_hidden(const Document& document, std::vector<std::uint32_t> vertices);

/// Nothing of it is selected any more.
void hide_selected(Document& document);
/// All but what is selected.
void hide_others(Document& document);
void show_all(Document& document);

/// What is selected, as "Set 1" or the next number; requires a selection of the cage.
void save_set(Document& document);
/// It is selected, added to the selection or taken out of it, which is then of its kind.
void select_set(Document& document, std::size_t set, SelectMode mode);
/// An empty name changes nothing, nor does that of another set.
void rename_set(Document& document, std::size_t set, const std::string& name);
void remove_set(Document& document, std::size_t set);

/// Where vertices of another cage come from vertices of this one, each from all of those: hidden are those
/// that come from hidden ones alone; sets go likewise, and those that have none left go.
CageGroups carried(const CageGroups& groups, std::size_t vertices,
                   const std::vector<std::span<const std::uint32_t>>& origins);
/// Names of sets that are not there any more, for a sentence: "Arm" and "Leg"; empty for none.
std::string lost_sets(const CageGroups& before, const CageGroups& after);

/// The vertices of the cage that move with the selection; none of probes.
std::vector<std::uint32_t> moving_vertices(const Document& document);

/// Another selection as an edit, without what is hidden. Where nothing is selected before and after there is
/// nothing to take back. Nothing may be in the hand.
void set_selection(Document& document, Selection selection);

}  // namespace viete::scene
