// Defects that the summary does not name: duplicate and non-manifold vertices, thin triangles, cuts through
// itself.
#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// Vertices at exactly the position of another one with a lower number, ascending; only those that a polygon
/// uses. O(n).
std::vector<std::uint32_t> duplicate_vertices(const Surface& surface);

/// Vertices where fans of triangles touch that have no edge in common there, ascending: no manifold has one,
/// though all its edges may have two triangles. O(n log n) at worst.
std::vector<std::uint32_t> nonmanifold_vertices(const Surface& surface);

/// Triangles with area (see has_area()) whose least height is below `ratio` of their longest edge, ascending.
/// Any length scale from 1e-100 to 1e100. O(n).
std::vector<std::uint32_t> thin_triangles(const Surface& surface, double ratio);

/// The triangles that another one crosses or, in the same plane, overlaps; ascending. Touching does not
/// count: neither neighbours at their common edge or vertex, whether they share it by number or by place, nor
/// parts that only meet. Triangles without area are left out. Exact: no tolerance. Any length scale from
/// 1e-100 to 1e100. A sweep along the longest axis of the box: O(n log n) and the pairs whose boxes overlap
/// there. progress may be null; throws base::Cancelled.
std::vector<std::uint32_t> self_intersecting_triangles(const Surface& surface,
                                                       base::Progress* progress = nullptr);

}  // namespace viete::mesh
