// Triangles as vector code computes distances to them. mesh::closest_on_triangle goes by cases, which lanes
// cannot, and says where the closest point is, which they need not know. Here each triangle has coordinates
// of its own: origin a, x along its longest edge a b, y inward in its plane, z along its normal. A point
// (x, y, z) is then
//
//     z^2                               from it, if (x, y) lies inside: left of all three edges;
//     z^2 + the least of e_1, e_2, e_3  else, e_i the squared distance from (x, y) to edge i in the plane.
//
// At t along an edge of length L and s beside it, e = (t - clamp(t, 0, L))^2 + s^2. For edge a b, t = x and
// s = y; for the others t and s are affine in x and y, three coefficients each. An (x, y) near an edge may be
// taken for inside or outside by rounding: both formulas then give the same. All takes one rotation into the
// coordinates, four affine functions, minima and selections, and no division.
#pragma once

#include <array>

#include "deform/bind_kernel.h"
#include "deform/cage.h"

namespace viete::deform {

/// Any triangle, its longest side near 1 at most; one without area is its longest edge, or its point. Writes
/// the origin of its coordinates.
DistanceTriangle<double> distance_triangle(const std::array<Vec3, 3>& corners, Vec3& origin);

DistanceTriangle<float> in_float(const DistanceTriangle<double>& triangle);

/// Of a triangle with its origin there: what makes coordinates of axes . point; see DistanceTriangle.
Vec3 shift_of(const DistanceTriangle<double>& triangle, const Vec3& origin);

}  // namespace viete::deform
