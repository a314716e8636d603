// What is asked of single triangles: whether they have an area, and how far they are from a point.
#pragma once

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

}  // namespace viete::mesh
