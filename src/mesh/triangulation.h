// Polygons cut into triangles.
#pragma once

#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// True if the fan about the first corner covers the polygon: seen along its normal (Newell's: the sum of the
/// fan's own), no triangle of the fan that has area lies face down. Of all convex ones, and of those without
/// area, which nothing covers better.
bool is_fan(std::span<const Point> corners);

/// n - 2 triangles, as places in corners, each ascending. The fan where that covers the polygon. Else ears,
/// by exact signs along its normal and the shortest cuts first: of every simple polygon, also of one that
/// touches itself, as where a bridge leads to a hole or corners are repeated, and nearly planar ones; none is
/// without area that need not be. Scaled or mirrored about the first corner a polygon is cut alike.
/// One that crosses itself gets as many triangles. In time n log n, but for ears that reach over many
/// corners.
std::vector<Triangle> triangulation(std::span<const Point> corners);

/// Cuts the polygons, as they are at these positions, into triangles: fills all that is
/// said of triangles from corners and polygon_starts.
void triangulate(Surface& surface);

}  // namespace viete::mesh
