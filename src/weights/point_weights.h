// For weights of handles at a point: handles as triangles, and mean value coordinates by their definition.
#pragma once

#include <array>
#include <span>

#include "pose/cage.h"
#include "pose/deformer.h"
#include "weights/bind_kernel.h"

namespace viete::weights {

using mesh::Vec3;

// Vector code computes distances from triangles without branches, unlike mesh::closest_on_triangle(). Each
// triangle has its own coordinates. The origin is a corner a, x points along the longest edge from a to b, y
// points inward in the plane, and z points along the normal. The squared distance of a point (x, y, z) is
//
//     z^2                         if (x, y) is inside, left of all three edges;
//     z^2 + min(e_1, e_2, e_3)    otherwise; e_i is the squared distance from (x, y) to edge i.
//
// Let t be the coordinate along an edge of length L, and s the distance from the edge's line. Then
// e = (t - clamp(t, 0, L))^2 + s^2. For the longest edge, t = x and s = y. For other edges, t and s are
// affine in x and y. Rounding can choose the wrong formula only near an edge, where the two formulas agree.

/// Returns a triangle in its own coordinates. Writes the origin of these coordinates to `origin`. The longest
/// side must be at most about 1. A triangle without area becomes its longest edge or a point.
DistanceTriangle<double> distance_triangle(const std::array<Vec3, 3>& corners, Vec3& origin);

DistanceTriangle<float> in_float(const DistanceTriangle<double>& triangle);

/// Returns axes * origin. The triangle's coordinates of a point p are axes * p minus this shift.
Vec3 shift_of(const DistanceTriangle<double>& triangle, const Vec3& origin);

/// A handle as a triangle, for distances.
struct HandleShape {
  mesh::Triangle corners;  ///< for a vertex, the same index three times
  /// A factor of weights by distance: 0 for a triangle without area and for a vertex without polygons,
  /// otherwise 1 or, for the n triangles of a split polygon, (n - 2) / n. A polygon then weighs as much as n
  /// - 2 triangles.
  double share;
};
HandleShape handle_shape(const pose::Cage& cage, pose::Elements elements, std::size_t handle);

/// Returns x - sum of weights[j] * handles[j], for a vertex at the rest position x. Rounds as blend() does,
/// so that a cage at rest reproduces all bits of x. If the difference is only a rounding error, returns 0,
/// because a pose that shrinks the model would not shrink the error. `handles` and x must have the same
/// origin.
Vec3 rest_offset(const pose::Cage& cage, std::span<const Vec3> handles, const Vec3& x,
                 std::span<const double> weights);

/// Adds the weights of the centers of Cage::elements to the corners of their polygons, in equal parts.
/// `weights` is [vertex of Cage::elements][lanes].
void share_centers(const pose::Cage& cage, double* weights, std::size_t lanes);

/// Computes mean value weights of the cage's vertices at p, with sum 1. With these weights, blended positions
/// reproduce affine poses of closed cages (Ju, Schaefer, Warren 2005; Floater, Kos, Reimers 2005). The mean
/// vector of a triangle is the integral of all unit directions from p to the triangle. It is split along the
/// directions to the triangle's corners. Over a closed cage the mean vectors cancel, so the weights reproduce
/// p. If p is nearer to the cage than cage.contact, the weights are barycentric. If the sum of the weights
/// vanishes (possible outside the cage or for an open cage), writes the weights of the cage's closest
/// point and returns false. weights.size() must be the number of vertices. Thread-safe.
bool mean_value_weights(const pose::Cage& cage, const mesh::Point& p, std::span<double> weights);

}  // namespace viete::weights
