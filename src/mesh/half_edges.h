// The edges of a surface, the sides of triangles along each edge, and paths along edges.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/adjacency.h"
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

/// The connected components of a surface, and short paths along edges. The surface must outlive the object.
/// Immutable and thread-safe.
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
