// The edges of a surface and the triangle sides along them.
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
  bool forward;  ///< the triangle's orientation runs from the lower vertex of the edge to the higher one
};

/// Edges of arbitrary triangles: one, two or more triangles per edge, in any orientation.
struct HalfEdges {
  std::vector<Edge> edges;            ///< sorted, each once
  std::vector<std::uint32_t> starts;  ///< one more than edges
  std::vector<HalfEdge> sides;        ///< edge e has sides[starts[e]] up to sides[starts[e + 1]], by triangle

  std::span<const HalfEdge> of(std::size_t e) const {
    return std::span(sides).subspan(starts[e], starts[e + 1] - starts[e]);
  }
};

/// Skips triangles that repeat a corner. Nearly linear: sorts within the edges of each vertex.
HalfEdges half_edges(std::size_t vertices, std::span<const Triangle> triangles);

/// The edges of a surface's polygons, sorted, each once: a quad has four, not five. Skips edges from a vertex
/// to itself. Nearly linear.
std::vector<Edge> polygon_edges(const Surface& surface);

}  // namespace viete::mesh
