// Triangles as vector code computes distances to them: each in a frame of its own. mesh::closest_on_triangle
// goes by cases, which lanes cannot, and says where the closest point is, which they need not know.
#pragma once

#include <array>

#include "deform/bind_kernel.h"
#include "deform/cage.h"

namespace viete::deform {

/// Any triangle, its longest side near 1 at most; one without area is its longest edge, or its point. Writes
/// the corner where its frame begins.
DistanceTriangle<double> distance_triangle(const std::array<Vec3, 3>& corners, Vec3& origin);

DistanceTriangle<float> in_float(const DistanceTriangle<double>& triangle);

/// Of a triangle whose frame begins there; see DistanceTriangle.
Vec3 shift_of(const DistanceTriangle<double>& triangle, const Vec3& origin);

}  // namespace viete::deform
