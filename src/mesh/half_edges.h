// The edges of a surface, and the sides of its faces that run along them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

using Edge = std::array<std::uint32_t, 2>;  ///< two different vertices (or nodes of a graph), the lower first

/// One side of a triangle.
struct HalfEdge {
  std::uint32_t triangle;
  bool forward;  ///< the triangle runs along the edge from its lower vertex to the higher one
};

/// Of any triangles: an edge may have one of them, two, or more, in any orientation.
struct HalfEdges {
  std::vector<Edge> edges;            ///< sorted, each once
  std::vector<std::uint32_t> starts;  ///< one more than edges
  std::vector<HalfEdge>
      sides;  ///< those of edge e are sides[starts[e]] up to sides[starts[e + 1]], by triangle

  std::span<const HalfEdge> of(std::size_t e) const {
    return std::span(sides).subspan(starts[e], starts[e + 1] - starts[e]);
  }
};

/// Triangles that repeat a corner have no edges. Nearly linear: sorted within the edges of each vertex.
HalfEdges half_edges(std::size_t vertices, std::span<const Triangle> triangles);

/// The edges of a surface's polygons, sorted, each once: a quad has four, not five. Edges between a vertex
/// and itself are left out. Nearly linear.
std::vector<Edge> polygon_edges(const Surface& surface);

}  // namespace viete::mesh
