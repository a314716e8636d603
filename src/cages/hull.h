// Convex hulls: the cage that never fails.
#pragma once

#include <span>
#include <vector>

#include "cages/extraction.h"

namespace viete::cages {

/// The convex hull of boxes with sides of 2 margin about all points: closed, oriented outward, at least
/// `margin` from every point, for points that lie in a plane or on a line too. Quickhull (Barber, Dobkin and
/// Huhdanpaa 1996) by exact signs of volumes. margin > 0, at least 1e-9 of the points' extent; at least one
/// point.
Shell hull(std::span<const Point> points, double margin);

/// The convex hull of points that do not lie in one plane.
Shell convex(std::span<const Point> points);

}  // namespace viete::cages
