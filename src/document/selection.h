// The selection: a set of cage elements of one kind; hidden vertices and named vertex sets.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace viete::document {

enum class SelectMode { replace, add, remove };

/// Vertices and edges of the cage (Cage::edges), its polygons, and probes.
enum class ElementKind { vertex, edge, face, probe };

/// Element indices of kind(), ascending and unique. For their vertices see selected_vertices() in
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
  /// The element that was last picked alone, while it is selected.
  std::optional<std::uint32_t> active() const;

  void clear() { indices_.clear(); }
  void select_all(std::size_t count);
  void invert(std::size_t count);
  /// picked must be ascending.
  void apply(std::span<const std::uint32_t> picked, SelectMode mode);

  /// Ignores the active element.
  friend bool operator==(const Selection& a, const Selection& b) {
    return a.kind_ == b.kind_ && a.indices_ == b.indices_;
  }

private:
  ElementKind kind_ = ElementKind::vertex;
  std::vector<std::uint32_t> indices_;
  std::uint32_t picked_ = 0;
  bool has_picked_ = false;
};

/// A saved selection: selects the elements of this kind whose vertices are all in it.
struct NamedSet {
  std::string name;
  ElementKind kind = ElementKind::vertex;  ///< not probe
  std::vector<std::uint32_t> vertices;     ///< ascending and unique

  friend bool operator==(const NamedSet&, const NamedSet&) = default;
};

struct CageGroups {
  /// Hidden vertices, ascending and unique: they cannot be dragged, and elements of hidden vertices alone are
  /// neither shown nor selected.
  std::vector<std::uint32_t> hidden;
  std::vector<NamedSet> sets;

  friend bool operator==(const CageGroups&, const CageGroups&) = default;
};

}  // namespace viete::document
