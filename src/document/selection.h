// The selection of cage elements or probes; hidden vertices; and named sets of vertices.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace viete::document {

enum class SelectMode { replace, add, remove };

/// Edges are indices of Cage::edges, faces are polygons of the cage.
enum class ElementKind { vertex, edge, face, probe };

/// A set of elements of one kind. For the vertices of the elements, see document/elements.h.
class Selection {
public:
  Selection() = default;
  /// `picked` must be ascending.
  explicit Selection(ElementKind kind, std::span<const std::uint32_t> picked = {}) : kind_(kind) {
    apply(picked, SelectMode::replace);
  }

  ElementKind kind() const { return kind_; }
  /// Ascending and unique.
  const std::vector<std::uint32_t>& indices() const { return indices_; }
  bool empty() const { return indices_.empty(); }
  std::size_t size() const { return indices_.size(); }
  bool contains(std::uint32_t index) const;
  /// Returns the last element that was picked alone; nullopt if it is no longer selected.
  std::optional<std::uint32_t> active() const;

  void clear() { indices_.clear(); }
  void select_all(std::size_t count);
  void invert(std::size_t count);
  /// `picked` must be ascending.
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

/// A saved selection: the elements of `kind` that have all their vertices in the set.
struct NamedSet {
  std::string name;
  ElementKind kind = ElementKind::vertex;  ///< never probe
  std::vector<std::uint32_t> vertices;     ///< ascending and unique

  friend bool operator==(const NamedSet&, const NamedSet&) = default;
};

struct CageGroups {
  /// Hidden vertices, ascending and unique. They cannot be dragged. An element whose vertices are all hidden
  /// is neither shown nor selectable.
  std::vector<std::uint32_t> hidden;
  std::vector<NamedSet> sets;

  friend bool operator==(const CageGroups&, const CageGroups&) = default;
};

}  // namespace viete::document
