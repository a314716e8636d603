// Triangulation of polygons.
#pragma once

#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// True if the fan about the first corner covers the polygon: seen along its normal (Newell's: the sum of the
/// fan's normals), no fan triangle with area is reversed. True for convex polygons and those without area.
bool is_fan(std::span<const Point> corners);

/// n - 2 triangles as indices into corners, each ascending. Uses the fan if it covers the polygon, otherwise
/// ear clipping with exact signs along the normal, shortest cuts first. Handles every simple polygon, nearly
/// planar ones, and polygons that touch themselves (bridges to holes, repeated corners); makes triangles
/// without area only where unavoidable. Scaling or mirroring about the first corner does not change the
/// result. Self-crossing polygons get n - 2 too. O(n log n), except for ears that span many corners.
std::vector<Triangle> triangulation(std::span<const Point> corners);

/// Triangulates all polygons at their current positions. Fills every triangle member of Surface from corners
/// and polygon_starts.
void triangulate(Surface& surface);

}  // namespace viete::mesh
