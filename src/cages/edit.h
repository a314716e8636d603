// Changes of a cage's polygons by hand. Whatever is not named stays as it is.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cages/subject.h"
#include "mesh/half_edges.h"
#include "mesh/surface.h"

namespace viete::cages {

/// Where a vertex comes from: the mean of these of the cage before, or, mirrored, of their images.
struct Origin {
  std::vector<std::uint32_t> of;
  bool mirrored = false;
};

struct Edited {
  mesh::Surface surface;
  std::vector<Origin> origins;           ///< of each vertex
  std::vector<std::uint32_t> selection;  ///< vertices that were made, or that a hand goes on with; ascending
};

/// All are pure and thread-safe. Vertices, edges and polygons are those of `cage`; each at most once.
/// Vertices that no polygon has any more go. Whether the result is a cage is for make_cage() to say.

/// A vertex in the middle of each edge, joined to the corners of its polygons, which become triangles.
Edited split_edges(const mesh::Surface& cage, std::span<const mesh::Edge> edges);
/// A vertex in the middle of each polygon, joined to its corners; if it does not see all sides, the polygon
/// becomes triangles, and the vertex is in the largest one.
Edited cut_polygons(const mesh::Surface& cage, std::span<const std::uint32_t> polygons);
/// One vertex in the middle of these. What is left of a polygon with fewer than three corners goes.
Edited merge_vertices(const mesh::Surface& cage, std::span<const std::uint32_t> vertices);
/// Without these vertices; the hole of each is one polygon, so that a closed cage stays closed.
Edited dissolve_vertices(const mesh::Surface& cage, std::span<const std::uint32_t> vertices);
/// The two polygons of each edge become one.
Edited dissolve_edges(const mesh::Surface& cage, std::span<const mesh::Edge> edges);
Edited remove_polygons(const mesh::Surface& cage, std::span<const std::uint32_t> polygons);
/// The polygons are moved along the mean of their normals, by so much, and quads join them to what is left.
Edited extrude(const mesh::Surface& cage, std::span<const std::uint32_t> polygons, double distance);
/// The same surface: of each triangle four, of every other polygon a quad for each of its corners; if its
/// middle does not see all sides, four of each of its triangles.
Edited subdivide(const mesh::Surface& cage);
/// The side of the plane where its normal points, cut off there, and its image.
Edited mirrored(const mesh::Surface& cage, const Plane& plane);

}  // namespace viete::cages
