// The connected components of a surface, and short paths along edges.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// Answers queries about one surface. The surface must outlive the object. Immutable and thread-safe.
class EdgePaths {
public:
  explicit EdgePaths(const Surface& surface);

  /// Returns the index of the vertex's component. Vertices that edges connect are in the same component.
  std::uint32_t part(std::uint32_t vertex) const { return parts_[vertex]; }
  std::span<const std::uint32_t> parts() const { return parts_; }
  /// True if there is a path along edges from a to b that is not longer than `longest`.
  bool joined(std::uint32_t a, std::uint32_t b, double longest) const;

private:
  std::span<const Point> positions_;
  Adjacency neighbours_;
  std::vector<std::uint32_t> parts_;
};

}  // namespace viete::mesh
