// Manual edits of a cage's polygons.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cages/subject.h"
#include "mesh/half_edges.h"
#include "mesh/surface.h"

namespace viete::cages {

/// The old vertices that define the displacement of a new vertex in a pose.
struct Origin {
  std::vector<std::uint32_t> of;  ///< the displacement is the mean of the displacements of these vertices
  bool mirrored = false;          ///< true if the displacement is also mirrored
};

struct Edited {
  mesh::Surface surface;
  std::vector<Origin> origins;           ///< one per vertex of the new surface
  std::vector<std::uint32_t> selection;  ///< the vertices to select after the edit, ascending
};

// The functions below are thread-safe and do not change `cage`. The given vertices, edges and polygons must
// belong to `cage` and must be unique. Vertices without polygons are removed. The result can be an invalid
// cage; see pose::make_cage().

/// Adds a vertex at the middle of each edge. Divides the polygons at the edge into triangles.
Edited split_edges(const mesh::Surface& cage, std::span<const mesh::Edge> edges);
/// Adds a vertex at the center of each polygon, with edges to the corners. If a polygon is not star-shaped
/// around its center, divides the polygon into triangles first, and adds the vertex to the largest triangle.
Edited cut_polygons(const mesh::Surface& cage, std::span<const std::uint32_t> polygons);
/// Merges the vertices at their mean position. Removes polygons with fewer than three remaining corners.
Edited merge_vertices(const mesh::Surface& cage, std::span<const std::uint32_t> vertices);
/// Removes the vertices. Merges the polygons around each vertex into one polygon.
Edited dissolve_vertices(const mesh::Surface& cage, std::span<const std::uint32_t> vertices);
/// Removes the edges. Merges the polygons at each edge into one polygon.
Edited dissolve_edges(const mesh::Surface& cage, std::span<const mesh::Edge> edges);
Edited remove_polygons(const mesh::Surface& cage, std::span<const std::uint32_t> polygons);
/// Removes patches of polygons until no edge has 3, 5, 7 or another larger odd number of triangles. Removes
/// open patches before closed patches, and small patches before large patches.
mesh::Surface without_fins(mesh::Surface cage);
/// Moves the polygons by `distance` along the mean of their normals. Adds quads along the boundary of the
/// polygons. If the normals cancel, moves each vertex along the normal of its own polygons.
Edited extrude(const mesh::Surface& cage, std::span<const std::uint32_t> polygons, double distance);
/// Divides each triangle into four triangles, and each other polygon into one quad per corner. The shape does
/// not change. If a polygon is not star-shaped around its center, divides the polygon into triangles first.
Edited subdivide(const mesh::Surface& cage);
/// Cuts the cage at the plane. Keeps the side to which the normal points, and adds its mirror image.
Edited mirrored(const mesh::Surface& cage, const Plane& plane);

}  // namespace viete::cages
