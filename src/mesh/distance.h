// How far a point is from a triangle.
#pragma once

#include "mesh/surface.h"

namespace viete::mesh {

/// The squared distance to the nearest point of triangle abc, which may be degenerate to a segment or a
/// point. Relative error about 1e-15 of the square of the largest distance between the four points. Lengths
/// within 1e-70 to 1e70.
double squared_distance(const Point& p, const Point& a, const Point& b, const Point& c);

}  // namespace viete::mesh
