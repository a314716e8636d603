// The edges of a surface, and the sides of triangles along each edge.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/surface.h"
#include "mesh/triangle.h"

namespace viete::mesh {

/// A side of a triangle.
struct HalfEdge {
  std::uint32_t triangle;
  bool forward;  ///< true if the side goes from the lower to the higher vertex index
};

/// The edges of triangles. An edge can have any number of triangles, in any orientation.
struct HalfEdges {
  std::vector<Edge> edges;            ///< sorted and unique
  std::vector<std::uint32_t> starts;  ///< edge e has sides[starts[e]] to sides[starts[e + 1] - 1]
  std::vector<HalfEdge> sides;        ///< sorted by edge, then by triangle

  std::span<const HalfEdge> of(std::size_t e) const {
    return std::span(sides).subspan(starts[e], starts[e + 1] - starts[e]);
  }
};

/// Returns the edges of the triangles. Ignores triangles that repeat a corner.
HalfEdges half_edges(std::size_t vertices, std::span<const Triangle> triangles);

/// Calls use(e, s, t) for each edge e that has exactly two sides s and t.
template <class Use>
void for_inner_edges(const HalfEdges& table, const Use& use) {
  for (std::size_t e = 0; e < table.edges.size(); ++e)
    if (const auto sides = table.of(e); sides.size() == 2) use(e, sides[0], sides[1]);
}

/// Calls use(a, b) for each side of a polygon. Ignores sides from a vertex to itself, and triangles that
/// repeat a corner.
template <class Use>
void for_polygon_sides(const Surface& surface, std::size_t polygon, const Use& use) {
  const auto corners = surface.polygon(polygon);
  if (corners.size() == 3 && repeats_corner({corners[0], corners[1], corners[2]})) return;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto a = corners[i], b = corners[i + 1 < corners.size() ? i + 1 : 0];
    if (a != b) use(a, b);
  }
}

/// Returns the edges of a surface's polygons, sorted and unique. See for_polygon_sides().
std::vector<Edge> polygon_edges(const Surface& surface);

}  // namespace viete::mesh
