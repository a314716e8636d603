// The selection: a set of cage elements of one kind; what of a cage is hidden, and sets of its vertices by
// name.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace viete::scene {

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

}  // namespace viete::scene
