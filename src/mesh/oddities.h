// Vertices and triangles that are not what they seem.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// Vertices at exactly the place of another one with a lower number, ascending; only those that a polygon
/// uses. O(n).
std::vector<std::uint32_t> doubled_vertices(const Surface& surface);

/// Vertices where fans of triangles touch that have no edge in common there, ascending: no manifold has one,
/// though all its edges may have two triangles. O(n log n) at worst.
std::vector<std::uint32_t> pinched_vertices(const Surface& surface);

/// Triangles with area (see Facts) whose least height is below `ratio` of their longest edge, ascending. Any
/// length scale from 1e-100 to 1e100. O(n).
std::vector<std::uint32_t> thin_triangles(const Surface& surface, double ratio);

}  // namespace viete::mesh
