// The neighbourhood of a cage's elements: who shares an edge with whom, and where branches start.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/half_edges.h"

namespace viete::deform {

struct DualGraph {
  std::vector<mesh::Edge> edges;  ///< pairs of elements i < j, sorted, each once
  std::size_t open = 0;           ///< edges with one triangle
  std::size_t nonmanifold = 0;    ///< edges with three or more
  std::size_t misoriented = 0;    ///< edges that two triangles run through in the same direction
  /// Edges of the surface with an odd number of triangles beyond one, all of them with area: a fin
  /// sticks out there, and neither side of it is inside.
  std::vector<mesh::Edge> fins;
};

/// Vertices at exactly the same place count as one. Skipped elements have no edges; their neighbours are
/// joined.
DualGraph dual_graph(const mesh::Surface& surface, std::span<const std::uint8_t> skip);

/// Pairs i < j of what is not skipped, sorted, each once; the neighbours of each cluster of skipped elements
/// are joined in a chain.
std::vector<mesh::Edge> without_skipped(std::vector<mesh::Edge> pairs, std::span<const std::uint8_t> skip);

/// The centre of each connected part, in the order of the parts' lowest elements: the element of least
/// eccentricity, lowest index first. Exact up to 4,096 elements in a part, beyond that the middle of a
/// longest path found by two sweeps, so that the cost stays O(4096 edges). Skipped elements have no part.
std::vector<std::uint32_t> graph_centers(std::size_t elements, std::span<const mesh::Edge> edges,
                                         std::span<const std::uint8_t> skip);

/// Of each element the place in `centers` of the one it hangs together with; centers.size() if with none.
std::vector<std::uint32_t> graph_parts(std::size_t elements, std::span<const mesh::Edge> edges,
                                       std::span<const std::uint32_t> centers);

}  // namespace viete::deform
