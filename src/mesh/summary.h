// Summary of a surface: counts, boundary, non-manifold and misoriented edges, area and volume.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/half_edges.h"

namespace viete::mesh {

/// Edges are triangle edges. A triangle with a repeated corner has none.
struct Summary {
  std::size_t vertices = 0, polygons = 0, triangles = 0, edges = 0;
  std::size_t parts = 0;                ///< components by shared vertices; unused vertices do not count
  std::vector<Edge> boundary_edges;     ///< edges with one triangle
  std::vector<Edge> nonmanifold_edges;  ///< edges with three or more
  std::vector<Edge> misoriented_edges;  ///< edges that two triangles use in the same direction
  std::vector<std::uint32_t> unused_vertices;
  std::vector<std::uint32_t> degenerate_triangles;  ///< a repeated corner, or not has_area()
  double area = 0;
  double volume = 0;  ///< signed, positive when oriented outward; meaningful when closed

  bool closed() const { return boundary_edges.empty() && triangles > 0; }
  bool manifold() const { return nonmanifold_edges.empty(); }
  bool oriented() const { return misoriented_edges.empty(); }
};

/// Linear time. Lists are ascending. Any length scale from 1e-100 to 1e100.
Summary summarize(const Surface& surface);

}  // namespace viete::mesh
