// Topology of a manifold: boundary loops and genus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "mesh/summary.h"
#include "mesh/surface.h"

namespace viete::mesh {

struct Topology {
  /// The vertices of each boundary loop, in the direction with the surface on the left. Each loop begins with
  /// its smallest vertex; loops are sorted by it.
  std::vector<std::vector<std::uint32_t>> boundary_loops;
  std::ptrdiff_t euler = 0;  ///< V - E + F, without unused vertices
  std::size_t genus = 0;     ///< handles of all components: euler = 2 components - 2 genus - boundary loops
};

/// Empty unless the surface is an oriented manifold: no edge with three triangles or with two of opposite
/// orientation, no triangle with repeated corners, no vertex with several fans. summary: of this surface.
/// Linear; about 0.4 microseconds a triangle. Thread-safe.
std::optional<Topology> topology(const Surface& surface, const Summary& summary);

}  // namespace viete::mesh
