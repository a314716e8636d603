// Finds duplicate vertices, non-manifold vertices, thin triangles and self-intersections.
#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// Returns each used vertex at exactly the same position as a used vertex of lower index. Sorted. O(n).
std::vector<std::uint32_t> duplicate_vertices(const Surface& surface);

/// Returns the vertices with several fans of triangles that have no common edge. A manifold has no such
/// vertex. Sorted. Nearly linear time.
std::vector<std::uint32_t> nonmanifold_vertices(const Surface& surface);

/// Returns the triangles whose smallest height is less than `ratio` times their longest edge. Ignores
/// triangles without area (see has_area()). Sorted. Lengths must be from 1e-100 to 1e100. O(n).
std::vector<std::uint32_t> thin_triangles(const Surface& surface, double ratio);

/// Returns the triangles that cross another triangle, or overlap a triangle in the same plane. Ignores
/// triangles that only touch, and triangles without area. The result is exact and sorted. Lengths must be
/// from 1e-100 to 1e100. The time is O(n log n) plus the number of pairs of overlapping boxes. `progress` may
/// be null. Throws base::Cancelled.
std::vector<std::uint32_t> self_intersecting_triangles(const Surface& surface,
                                                       base::Progress* progress = nullptr);

}  // namespace viete::mesh
