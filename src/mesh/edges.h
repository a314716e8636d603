// The edges of a surface's polygons, each once.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

using Edge = std::array<std::uint32_t, 2>;  ///< two different vertices, the lower one first

/// Sorted, each once: a quad has four, not five. Edges between a vertex and itself are left out. O(n log n).
std::vector<Edge> polygon_edges(const Surface& surface);

}  // namespace viete::mesh
