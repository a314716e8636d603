// On which side a point lies: signs of determinants, exact for any rounding.
#pragma once

#include <array>

#include "mesh/surface.h"

namespace viete::mesh {

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

}  // namespace viete::mesh
