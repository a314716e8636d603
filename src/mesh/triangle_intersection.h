// Whether two triangles cut through each other, exactly.
#pragma once

#include <array>

#include "mesh/surface.h"

namespace viete::mesh {

using Corners = std::array<Point, 3>;

/// The corners are not on one line, exactly.
bool has_plane(const Corners& t);

/// One crosses the other or, in the same plane, overlaps it. Touching does not count. Both must have a plane;
/// coordinates are 0 or within 1e-70 to 1e70 in size. Exact: no tolerance.
bool intersect(const Corners& s, const Corners& t);

/// The segment goes through the triangle: its ends lie strictly on both sides, and its line meets it.
bool crosses(const Point& p, const Point& q, const Corners& t);

/// intersect(), of any triangles: one without a plane cuts as its edges do, and two such ones never.
bool cut(const Corners& s, const Corners& t);

/// 0 where they cut each other. Any triangles: those without area are their longest edge, or their point. Lengths
/// from 1e-75 to 1e75.
double squared_distance(const Corners& s, const Corners& t);

}  // namespace viete::mesh
