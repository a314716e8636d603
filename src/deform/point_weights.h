// Weights of cage elements at a point: inverse distance, cut-off, and mean value coordinates.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "deform/bind_kernel.h"
#include "deform/cage.h"
#include "deform/scheme.h"

namespace viete::deform {

// Triangles in the form that vector code uses for distances. mesh::closest_on_triangle branches, which lanes
// cannot, and finds the closest point, which is not needed here. Each triangle has its own coordinates:
// origin a, x along its longest edge a b, y inward in its plane, z along its normal. The squared distance of
// a point (x, y, z) is
//
//     z^2                               if (x, y) lies inside: left of all three edges;
//     z^2 + the least of e_1, e_2, e_3  otherwise, e_i the squared distance from (x, y) to edge i in the
//     plane.
//
// At t along an edge of length L and at distance s from its line, e = (t - clamp(t, 0, L))^2 + s^2. For edge
// a b, t = x and s = y; for the others t and s are affine in x and y, three coefficients each. Rounding may
// misclassify an (x, y) near an edge; both formulas give the same result there. The cost is one rotation into
// the coordinates, four affine functions, minima and selections; no division.

/// Accepts any triangle whose longest side is at most about 1; one without area becomes its longest edge, or
/// its point. Writes the origin of its coordinates.
DistanceTriangle<double> distance_triangle(const std::array<Vec3, 3>& corners, Vec3& origin);

DistanceTriangle<float> in_float(const DistanceTriangle<double>& triangle);

/// The shift that turns axes . point into coordinates of a triangle with this origin; see DistanceTriangle.
Vec3 shift_of(const DistanceTriangle<double>& triangle, const Vec3& origin);

/// weights[i] = w_i / sum of w_j, w = d^-2: each in [0, 1], sum 1.
///
/// Formed from ratios of distances, so no length scale overflows. Distances below cage.contact are raised to
/// it: a point on the cage has the limit, equal shares for the touching elements and nearly 0 for the rest.
/// weights.size(): one per element of this kind; elements without extent (see HandleShape) get 0.
void inverse_distance_weights(const Cage& cage, const mesh::Point& p, std::span<double> weights,
                              Elements elements = Elements::face);

/// The geometry of a handle, for distances.
struct HandleShape {
  mesh::Triangle corners;  ///< for a vertex, the same index three times
  bool weighs;             ///< false for faces without area and vertices of no polygon
};
HandleShape handle_shape(const Cage& cage, Elements elements, std::size_t handle);

/// x - sum w h of a vertex at rest position x, rounded as blend() does, so that a cage at rest reproduces x
/// to the last bits. Rounding errors of x itself are set to 0: they would not shrink with the pose. handles
/// and x must be relative to the same origin.
Vec3 rest_offset(const Cage& cage, std::span<const Vec3> handles, const Vec3& x,
                 std::span<const double> weights);

/// Share of the motion for a point whose weights sum to `total` before normalisation. Totals above 1 give 1;
/// points reached only by the margins of a few elements get less.
inline double share_of_motion(double total) {
  return std::min(total, 1.0);
}

/// weights[i] = w_i / t with
///
///     w = (1 - d / r)^2 where d < r, and 0 beyond;    t = sum of w_i
///
/// where d is the exact unsigned distance to the handle and r the radius. Returns t; the point's share is
/// share_of_motion(t). If no handle reaches the point, t and all weights are 0. Handles without extent (see
/// HandleShape) get 0. weights.size(): one per handle. Any length scale: the radius is in diagonals of the
/// cage.
double cut_off_weights(const Cage& cage, const mesh::Point& p, const Weighting& weighting,
                       std::span<double> weights);

/// Weights of the cage's vertices at p, sum 1; positions blended with them reproduce affine poses of closed
/// cages. Each triangle's mean vector (the integral of the unit directions it covers) is split along the
/// directions to its corners; over a closed cage the mean vectors cancel, so the weights reproduce p (Ju,
/// Schaefer, Warren 2005; Floater, Kos, Reimers 2005). On the cage (nearer than cage.contact) they are
/// barycentric. If the sum vanishes (possible outside, or for open cages) they do not exist: writes the
/// weights of the closest point of the cage and returns false. weights.size() ==
/// cage.surface.positions.size(). Thread-safe.
bool mean_value_weights(const Cage& cage, const mesh::Point& p, std::span<double> weights);

}  // namespace viete::deform
