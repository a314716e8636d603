// Connected components of a surface's edges, and short paths along edges.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// Borrows the surface's positions. Immutable; thread-safe.
class EdgePaths {
public:
  explicit EdgePaths(const Surface& surface);

  /// The component of a vertex: vertices joined by edges, directly or not, have the same number.
  std::uint32_t part(std::uint32_t vertex) const { return parts_[vertex]; }
  std::span<const std::uint32_t> parts() const { return parts_; }
  /// True if a path along edges leads from a to b and is at most `longest` long.
  bool joined(std::uint32_t a, std::uint32_t b, double longest) const;

private:
  std::span<const Point> positions_;
  Adjacency neighbours_;
  std::vector<std::uint32_t> parts_;
};

}  // namespace viete::mesh
