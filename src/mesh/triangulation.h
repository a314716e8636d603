// Triangulates polygons.
#pragma once

#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// True if the fan around the first corner covers the polygon: no fan triangle is thin, or reversed relative
/// to the sum of the fan's normals. For quads, the other diagonal must not be better. Always true for
/// polygons without area.
bool is_fan(std::span<const Point> corners);

/// Returns n - 2 triangles for any polygon of n corners. Each triangle has three ascending indices into
/// `corners`. If is_fan(), returns the fan. Otherwise clips ears
/// with exact tests, beginning with the shortest cut. Makes thin triangles, and triangles without area, only
/// if necessary: a corner in the middle of an edge is joined to the other corners. The polygon can be
/// slightly non-planar, and can touch itself, for example at a bridge to a hole. Scaling or mirroring about
/// the first corner does not change the result. O(n log n), except if ears span many corners.
std::vector<Triangle> triangulation(std::span<const Point> corners);

/// Triangulates all polygons at their current positions. Sets `triangles`, `triangle_polygon` and `clipped`.
void triangulate(Surface& surface);

/// A surface with other triangles, so that no diagonal and no first corner matters. A polygon of four or more
/// corners has one triangle per side, to its center, which is the mean of its corners. A concave polygon that
/// does not surround its center has the triangles of triangulation() from its lowest vertex.
struct CenterSplit {
  Surface
      surface;  ///< `positions` are those of the original, then the centers; the polygons are the original's
  std::vector<std::uint32_t> polygons;  ///< the polygon of each center
};

/// Polygons with a mark in `skipped`, which may be empty, have no triangles.
CenterSplit split_at_centers(const Surface& surface, std::span<const std::uint8_t> skipped = {});
/// Works like split_at_centers(), but with fewer centers: a quad with a better diagonal, see
/// settled_corner(), is split there, and a polygon with more than `most` corners has no center.
CenterSplit split_unsettled(const Surface& surface, std::size_t most);

/// Returns the corner, 0 or 1, from which the better diagonal of a quad starts: the only one that covers the
/// quad, or the shorter one. Returns `none` for other polygons, and if the lengths are equal up to 1e-6.
std::uint32_t settled_corner(std::span<const Point> corners);

/// Returns positions for the vertices of a CenterSplit, from positions of the vertices of `surface`.
std::vector<Point> with_centers(const Surface& surface, std::span<const std::uint32_t> polygons,
                                std::span<const Point> positions);

}  // namespace viete::mesh
