// Manual edits of a cage's polygons. Everything not named stays unchanged.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cages/subject.h"
#include "mesh/half_edges.h"
#include "mesh/surface.h"

namespace viete::cages {

/// Source of a vertex: the mean of these old vertices, or, if mirrored, of their mirror images.
struct Origin {
  std::vector<std::uint32_t> of;
  bool mirrored = false;
};

struct Edited {
  mesh::Surface surface;
  std::vector<Origin> origins;           ///< one per vertex
  std::vector<std::uint32_t> selection;  ///< new vertices and those to edit next; ascending
};

/// All functions are pure and thread-safe. Vertices, edges and polygons refer to `cage`, each given at most
/// once. Vertices left without polygons are removed. make_cage() checks whether the result is a valid cage.

/// Adds a vertex at each edge's midpoint. The adjacent polygons become triangles around it.
Edited split_edges(const mesh::Surface& cage, std::span<const mesh::Edge> edges);
/// Adds a vertex at each polygon's centre and joins it to the corners. If the centre does not see all sides,
/// triangulates the polygon and adds the vertex to the largest triangle.
Edited cut_polygons(const mesh::Surface& cage, std::span<const std::uint32_t> polygons);
/// Merges the vertices into one at their mean. Polygons left with fewer than three corners are removed.
Edited merge_vertices(const mesh::Surface& cage, std::span<const std::uint32_t> vertices);
/// Removes the vertices. Each hole becomes one polygon, so that a closed cage stays closed.
Edited dissolve_vertices(const mesh::Surface& cage, std::span<const std::uint32_t> vertices);
/// Merges the two polygons at each edge.
Edited dissolve_edges(const mesh::Surface& cage, std::span<const mesh::Edge> edges);
Edited remove_polygons(const mesh::Surface& cage, std::span<const std::uint32_t> polygons);
/// Removes patches of polygons, open ones first, then the smallest, until no edge has an odd number of
/// triangles above one.
mesh::Surface without_fins(mesh::Surface cage);
/// Moves the polygons along the mean of their normals by `distance`; quads join them to the rest.
Edited extrude(const mesh::Surface& cage, std::span<const std::uint32_t> polygons, double distance);
/// Subdivides without changing the shape: a triangle into four, any other polygon into one quad per corner;
/// if its centre does not see all sides, each of its triangles into four.
Edited subdivide(const mesh::Surface& cage);
/// Keeps the side that the plane's normal points to, cuts it at the plane and adds its mirror image.
Edited mirrored(const mesh::Surface& cage, const Plane& plane);

}  // namespace viete::cages
