// Defects beyond the summary: duplicate and non-manifold vertices, thin triangles, self-intersections.
#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// Used vertices at exactly the same position as a vertex with a lower number, ascending. O(n).
std::vector<std::uint32_t> duplicate_vertices(const Surface& surface);

/// Vertices with several triangle fans that share no edge there, ascending. A manifold has none, although a
/// surface with such vertices can have two triangles at every edge. O(n log n) at worst.
std::vector<std::uint32_t> nonmanifold_vertices(const Surface& surface);

/// Triangles with area (see has_area()) whose least height is below `ratio` of their longest edge, ascending.
/// Any length scale from 1e-100 to 1e100. O(n).
std::vector<std::uint32_t> thin_triangles(const Surface& surface, double ratio);

/// The triangles that cross another one or overlap it in the same plane; ascending. Touching does not count:
/// neither neighbours at their common edge or vertex (shared by number or by position), nor parts in contact.
/// Skips triangles without area. Exact: no tolerance. Any length scale from 1e-100 to 1e100. A sweep along
/// the longest axis of the bounding box: O(n log n + pairs of boxes that overlap on that axis). progress may
/// be null; throws base::Cancelled.
std::vector<std::uint32_t> self_intersecting_triangles(const Surface& surface,
                                                       base::Progress* progress = nullptr);

}  // namespace viete::mesh
