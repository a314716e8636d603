// The point of a triangle that is closest to a given point.
#pragma once

#include "deform/cage.h"

namespace viete::deform {

struct Closest {
  double squared_distance;
  Vec3 barycentric;  ///< of the closest point, at a, b, c; in [0, 1], sum 1
};

/// Both sides, any triangle: one without area is its longest edge, or its point. Lengths from 1e-75 to 1e75.
/// After C. Ericson, Real-Time Collision Detection (2005), 5.1.5 (regions by signs of areas).
Closest closest_on_triangle(const mesh::Point& p, const mesh::Point& a, const mesh::Point& b,
                            const mesh::Point& c);

}  // namespace viete::deform
