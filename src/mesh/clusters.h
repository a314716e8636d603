// Simplification of large surfaces for drawing.
#pragma once

#include <cstddef>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// About `wanted` triangles between vertices of the surface: one vertex stands for all in a cell of a grid
/// (Rossignac and Borrel 1993), so that deformed vertices deform these triangles too. area: of the surface.
/// Empty without area. Linear time.
std::vector<Triangle> clustered_triangles(const Surface& surface, double area, std::size_t wanted);

}  // namespace viete::mesh
