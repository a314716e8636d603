// Summarizes a surface: counts; boundary, non-manifold and misoriented edges; area and volume.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "mesh/half_edges.h"

namespace viete::mesh {

/// Edges and areas are those of the polygons, see for_polygon_sides(). They do not depend on the
/// triangulation.
struct Summary {
  std::size_t vertices = 0, polygons = 0, triangles = 0, edges = 0;
  std::size_t parts = 0;                ///< number of components; unused vertices are not components
  std::vector<Edge> boundary_edges;     ///< edges with one polygon
  std::vector<Edge> nonmanifold_edges;  ///< edges with three or more polygons
  std::vector<Edge> misoriented_edges;  ///< edges that two polygons use in the same direction
  std::vector<std::uint32_t> unused_vertices;
  std::vector<std::uint32_t> degenerate_polygons;  ///< polygons of triangles without area, see has_area()
  double area = 0;
  double volume = 0;  ///< positive if oriented outward; meaningful only for a closed surface

  bool closed() const { return boundary_edges.empty() && triangles > 0; }
  bool manifold() const { return nonmanifold_edges.empty(); }
  bool oriented() const { return misoriented_edges.empty(); }
  bool inside_out() const { return closed() && manifold() && oriented() && volume < 0; }
};

/// Lists are sorted. Linear time. Lengths must be from 1e-100 to 1e100. At most 2^31 vertices.
Summary summarize(const Surface& surface);

/// The topology of a manifold.
struct Topology {
  std::size_t holes = 0;     ///< boundary loops
  std::ptrdiff_t euler = 0;  ///< vertices - edges + polygons, without unused vertices
  std::size_t genus = 0;     ///< number of handles: euler = 2 * parts - 2 * genus - holes
};

/// Returns nullopt if the surface is not an oriented manifold or a triangle repeats a corner. `summary` must
/// be the summary of this surface.
std::optional<Topology> topology(const Surface& surface, const Summary& summary);

}  // namespace viete::mesh
