// Which vertices of a surface its edges join, and whether a short way leads from one to another.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// Borrows the surface's positions. Constant; thread-safe.
class EdgePaths {
public:
  explicit EdgePaths(const Surface& surface);

  /// A number that all vertices have which edges join, directly or not.
  std::uint32_t part(std::uint32_t vertex) const { return parts_[vertex]; }
  std::span<const std::uint32_t> parts() const { return parts_; }
  /// A path along edges, no longer than that, leads from a to b.
  bool joined(std::uint32_t a, std::uint32_t b, double longest) const;

private:
  std::span<const Point> positions_;
  Adjacency neighbours_;
  std::vector<std::uint32_t> parts_;
};

}  // namespace viete::mesh
