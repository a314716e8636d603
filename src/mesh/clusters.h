// Simplifies large surfaces for drawing.
#pragma once

#include <cstddef>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// Returns about `wanted` triangles for fast drawing (Rossignac and Borrel 1993). In each cell of a grid, one
/// vertex of the surface replaces all vertices. `area` is the area of the surface; if it is 0, returns no
/// triangles. Linear time.
std::vector<Triangle> clustered_triangles(const Surface& surface, double area, std::size_t wanted);

}  // namespace viete::mesh
