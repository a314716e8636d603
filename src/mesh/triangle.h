// Predicates and measures of single triangles and points: orientation, area, distance, intersection.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// True if two corners are equal: the triangle has no area and no proper edges.
inline bool repeats_corner(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// The triangles that do not repeat a corner, in order.
std::vector<Triangle> proper_triangles(const Surface& surface);

/// False if the triangle is a line or a point up to rounding: twice its area is at most 1e-12 times the
/// square of the largest coordinate of its sides. Any length scale from 1e-300 to 1e300.
bool has_area(const Point& a, const Point& b, const Point& c);

struct Closest {
  double squared_distance;
  Vec3 barycentric;  ///< weights of a, b, c for the closest point, in [0, 1], sum 1
};

/// Works for any triangle: one without area acts as its longest edge, or as a point. Lengths 1e-75 to 1e75.
/// Source: C. Ericson, Real-Time Collision Detection (2005), 5.1.5 (regions by signs of areas).
Closest closest_on_triangle(const Point& p, const Point& a, const Point& b, const Point& c);

/// Half the signed solid angle of the triangle seen from the origin (van Oosterom and Strackee 1983, eq. 8).
double half_solid_angle(const Point& a, const Point& b, const Point& c);

using Point2 = std::array<double, 2>;

/// The sign of det(b - a, c - a, d - a): 1 if abc appears counter-clockwise from d, -1 if clockwise, 0
/// exactly in the plane. Coordinates must be 0 or 1e-70 to 1e70 in size. Evaluates a filter with a bound on
/// rounding; if that leaves the sign open, an exact sum. Source: Shewchuk 1997, Adaptive precision
/// floating-point arithmetic and fast robust geometric predicates.
int orientation(const Point& a, const Point& b, const Point& c, const Point& d);

/// The sign of det(b - a, c - a, normal): 1 if a, b, c appear counter-clockwise when viewed against the
/// normal, 0 if they appear exactly collinear. Same range of coordinates.
int orientation_along(const Vec3& normal, const Point& a, const Point& b, const Point& c);

/// The sign of det(b - a, c - a): 1 if a, b, c run counter-clockwise, 0 if exactly collinear.
int orientation(const Point2& a, const Point2& b, const Point2& c);

using Corners = std::array<Point, 3>;

inline Corners corners_of(std::span<const Point> positions, const Triangle& t) {
  return {positions[t[0]], positions[t[1]], positions[t[2]]};
}

/// True if the corners are not collinear, exactly.
bool has_plane(const Corners& t);

/// True if the triangles cross or, in the same plane, overlap. Touching does not count. Both must have a
/// plane. Coordinates must be 0 or 1e-70 to 1e70 in size. Exact: no tolerance.
bool intersect(const Corners& s, const Corners& t);

/// True if the segment passes through the triangle: its ends lie strictly on opposite sides.
bool crosses(const Point& p, const Point& q, const Corners& t);

/// As intersect(), for any triangles: one without a plane acts as its edges; two without a plane never cut.
bool cut(const Corners& s, const Corners& t);

/// 0 if they cut each other. Works for any triangles: one without area acts as its longest edge, or as a
/// point. Lengths from 1e-75 to 1e75.
double squared_distance(const Corners& s, const Corners& t);

}  // namespace viete::mesh
