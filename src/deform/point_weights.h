// Weights of cage elements at a point: inverse distance, cut-off, and mean value coordinates.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "deform/bind_kernel.h"
#include "deform/cage.h"
#include "deform/scheme.h"

namespace viete::deform {

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

/// Any triangle, its longest side near 1 at most; one without area is its longest edge, or its point. Writes
/// the origin of its coordinates.
DistanceTriangle<double> distance_triangle(const std::array<Vec3, 3>& corners, Vec3& origin);

DistanceTriangle<float> in_float(const DistanceTriangle<double>& triangle);

/// Of a triangle with its origin there: what makes coordinates of axes . point; see DistanceTriangle.
Vec3 shift_of(const DistanceTriangle<double>& triangle, const Vec3& origin);

/// weights[i] = w_i / sum of w_j, w = d^-2: each in [0, 1], sum 1.
///
/// Formed from ratios of distances, so that nothing overflows at any length scale; distances below
/// cage.contact count as that, so that a point on elements has the limit: equal shares of the elements
/// touched, the rest next to nothing. weights.size(): one an element of that kind; those without extent (see
/// HandleShape) get 0.
void inverse_distance_weights(const Cage& cage, const mesh::Point& p, std::span<double> weights,
                              Elements elements = Elements::face);

/// Where a handle lies, for distances.
struct HandleShape {
  mesh::Triangle corners;  ///< of a vertex this three times
  bool weighs;             ///< false for faces without area, vertices of no polygon
};
HandleShape handle_shape(const Cage& cage, Elements elements, std::size_t handle);

/// Of a vertex at x at rest: x - sum w h, taken as blend() takes it, so that a cage at rest gives x back to
/// the last bits. What is only the rounding of x itself is dropped: it would not shrink with a pose that
/// does. handles and x relative to the same origin.
Vec3 rest_offset(const Cage& cage, std::span<const Vec3> handles, const Vec3& x,
                 std::span<const double> weights);

/// How much of its motion a point makes whose weights sum to `total` before they are made 1: all from 1 on,
/// less where only the margin of a few elements reaches it.
inline double share_of_motion(double total) {
  return std::min(total, 1.0);
}

/// weights[i] = w_i / t of
///
///     w = (1 - d / r)^2 where d < r, and 0 beyond;    t = sum of w_i
///
/// d being the exact distance to the handle, both sides, and r the radius.
/// Returns t, of which share_of_motion() makes what the point follows; where no handle reaches t and all
/// weights are 0. Handles without extent (see HandleShape) get 0. weights.size(): one a handle. Any length
/// scale: the radius is in diagonals of the cage.
double cut_off_weights(const Cage& cage, const mesh::Point& p, const Weighting& weighting,
                       std::span<double> weights);

/// Weights of the cage's vertices at p, sum 1: positions blended with them reproduce affine poses of closed
/// cages. Each triangle's mean vector (integral of the unit directions it covers) is split along the
/// directions to its corners; over a closed cage the mean vectors cancel, so the weights reproduce p (Ju,
/// Schaefer, Warren 2005; Floater, Kos, Reimers 2005). On the cage (nearer than cage.contact): barycentric.
/// Where the sum vanishes (it can outside, or for open cages) the coordinates do not exist: the weights of
/// the closest point of the cage, and the answer is false. weights.size() == cage.surface.positions.size().
/// Thread-safe.
bool mean_value_weights(const Cage& cage, const mesh::Point& p, std::span<double> weights);

}  // namespace viete::deform
