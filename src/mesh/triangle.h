// Questions about single triangles and a few points: sides, areas, distances, intersections.
#pragma once

#include <array>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// Such a triangle has no area and no proper edges.
inline bool repeats_corner(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// The triangles that do not repeat a corner, in order.
std::vector<Triangle> proper_triangles(const Surface& surface);

/// False if the triangle is a line or a point up to rounding: if twice its area is at most 1e-12 times the
/// square of the largest coordinate of its sides. Any length scale from 1e-300 to 1e300.
bool has_area(const Point& a, const Point& b, const Point& c);

struct Closest {
  double squared_distance;
  Vec3 barycentric;  ///< of the closest point, at a, b, c; in [0, 1], sum 1
};

/// Both sides, any triangle: one without area is its longest edge, or its point. Lengths from 1e-75 to 1e75.
/// After C. Ericson, Real-Time Collision Detection (2005), 5.1.5 (regions by signs of areas).
Closest closest_on_triangle(const Point& p, const Point& a, const Point& b, const Point& c);

/// Half the signed solid angle of the triangle seen from the origin (van Oosterom and Strackee 1983, eq. 8).
double half_solid_angle(const Point& a, const Point& b, const Point& c);

using Point2 = std::array<double, 2>;

/// The sign of det(b - a, c - a, d - a): 1 if d lies on the side of triangle abc that sees it
/// counter-clockwise, -1 on the other side, 0 exactly in the plane. Coordinates are 0 or within
/// 1e-70 to 1e70 in size. A filter by a bound of the rounding, then, where that leaves the sign open, an
/// exact sum. Source: Shewchuk 1997, Adaptive precision floating-point arithmetic and fast robust geometric
/// predicates.
int orientation(const Point& a, const Point& b, const Point& c, const Point& d);

/// The sign of det(b - a, c - a, normal): 1 if a, b, c run counter-clockwise for who looks against the
/// normal, 0 exactly on a line as seen along it. Same sizes.
int orientation_along(const Vec3& normal, const Point& a, const Point& b, const Point& c);

/// The sign of det(b - a, c - a): 1 if a, b, c run counter-clockwise, 0 exactly on a line.
int orientation(const Point2& a, const Point2& b, const Point2& c);

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

/// 0 where they cut each other. Any triangles: those without area are their longest edge, or their point.
/// Lengths from 1e-75 to 1e75.
double squared_distance(const Corners& s, const Corners& t);

}  // namespace viete::mesh
