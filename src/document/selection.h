// The selection of cage elements or probes, the hidden vertices, and the named sets of vertices.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace viete::document {

enum class SelectMode { replace, add, remove };

/// The kinds of elements. Edges are indices of Cage::edges, and faces are polygons of the cage.
enum class ElementKind { vertex, edge, face, probe };

/// A set of elements of one kind. document/elements.h has functions for the vertices of the elements.
class Selection {
public:
  Selection() = default;
  /// `picked` must be ascending.
  explicit Selection(ElementKind kind, std::span<const std::uint32_t> picked = {}) : kind_(kind) {
    apply(picked, SelectMode::replace);
  }

  ElementKind kind() const { return kind_; }
  /// Returns the selected elements, ascending and unique.
  const std::vector<std::uint32_t>& indices() const { return indices_; }
  bool empty() const { return indices_.empty(); }
  std::size_t size() const { return indices_.size(); }
  bool contains(std::uint32_t index) const;
  /// Returns the last element that the user picked alone. If it is no longer selected, returns nullopt.
  std::optional<std::uint32_t> active() const;

  void clear() { indices_.clear(); }
  void select_all(std::size_t count);
  void invert(std::size_t count);
  /// `picked` must be ascending.
  void apply(std::span<const std::uint32_t> picked, SelectMode mode);

  /// True if kind and elements are equal. The active element may differ.
  friend bool operator==(const Selection& a, const Selection& b) {
    return a.kind_ == b.kind_ && a.indices_ == b.indices_;
  }

private:
  ElementKind kind_ = ElementKind::vertex;
  std::vector<std::uint32_t> indices_;
  std::uint32_t picked_ = 0;
  bool has_picked_ = false;
};

/// A saved selection. Selects the elements of `kind` whose vertices are all in the set.
struct NamedSet {
  std::string name;
  ElementKind kind = ElementKind::vertex;  ///< must not be probe
  std::vector<std::uint32_t> vertices;     ///< ascending and unique

  friend bool operator==(const NamedSet&, const NamedSet&) = default;
};

struct CageGroups {
  /// The hidden vertices, ascending and unique. The user cannot drag them. If all vertices of an element are
  /// hidden, the element is not shown and cannot be selected.
  std::vector<std::uint32_t> hidden;
  std::vector<NamedSet> sets;

  friend bool operator==(const CageGroups&, const CageGroups&) = default;
};

}  // namespace viete::document
