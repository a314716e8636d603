// Tests and measures triangles and points: orientation, area, distance, intersection.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// True if two corners are the same vertex.
inline bool repeats_corner(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// Returns the triangles that do not repeat a corner.
std::vector<Triangle> proper_triangles(const Surface& surface);

/// True if 2 * area > 1e-12 * L^2, where L is the largest absolute coordinate of a side vector. False for
/// lines and points, even after rounding. Lengths must be from 1e-300 to 1e300.
bool has_area(const Point& a, const Point& b, const Point& c);
inline double area(std::span<const Point> p, const Triangle& t) {
  return norm(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]])) / 2;
}

struct Closest {
  double squared_distance;
  Vec3 barycentric;  ///< the weights of a, b and c for the closest point: in [0, 1], with sum 1
};

/// Returns the point of the triangle closest to p. Treats a triangle without area as its longest edge, or as
/// a point. Lengths: 1e-75 to 1e75. Source: C. Ericson, Real-Time Collision Detection (2005), 5.1.5.
Closest closest_on_triangle(const Point& p, const Point& a, const Point& b, const Point& c);

/// Returns half the solid angle of the triangle at the origin (van Oosterom and Strackee 1983, eq. 8).
double half_solid_angle(const Point& a, const Point& b, const Point& c);

using Point2 = std::array<double, 2>;

// The next functions return exact signs. Absolute values of coordinates must be 0 or from 1e-70 to 1e70.
// Source: Shewchuk 1997, Adaptive precision floating-point arithmetic and fast robust geometric predicates.

/// Returns the sign of det(b - a, c - a, d - a). The sign is 1 if a, b, c are counter-clockwise as seen from
/// d, and 0 if all four points are in a plane.
int orientation(const Point& a, const Point& b, const Point& c, const Point& d);

/// Returns the sign of det(b - a, c - a, normal): 1 if a, b, c are counter-clockwise around the normal.
int orientation_along(const Vec3& normal, const Point& a, const Point& b, const Point& c);

/// Returns the sign of det(b - a, c - a): 1 if a, b, c are counter-clockwise, and 0 if they are collinear.
int orientation(const Point2& a, const Point2& b, const Point2& c);

using Corners = std::array<Point, 3>;

inline Corners corners_of(std::span<const Point> positions, const Triangle& t) {
  return {positions[t[0]], positions[t[1]], positions[t[2]]};
}

/// True if the corners are not on a line. Exact.
bool has_plane(const Corners& t);

/// True if the triangles intersect, or overlap in one plane. False if they only touch. Both triangles must
/// have a plane. Exact.
bool intersect(const Corners& s, const Corners& t);

/// True if the segment from p to q passes through the triangle. False if p or q is on the triangle's plane.
bool crosses(const Point& p, const Point& q, const Corners& t);

/// Works like intersect(), but treats a triangle without a plane as three edges. If both triangles have no
/// plane, returns false.
bool cut(const Corners& s, const Corners& t);

/// Returns the squared distance; 0 if the triangles intersect. Treats a triangle without area as its longest
/// edge, or as a point. Lengths must be from 1e-75 to 1e75.
double squared_distance(const Corners& s, const Corners& t);

}  // namespace viete::mesh
