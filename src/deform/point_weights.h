// Weights of cage elements at a point: inverse distance, cut-off and mean value weights.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "deform/bind_kernel.h"
#include "deform/cage.h"
#include "deform/scheme.h"

namespace viete::deform {

// Vector code computes distances from triangles without branches, unlike mesh::closest_on_triangle(). Each
// triangle has its own coordinates: origin a, x along its longest edge a b, y inward in its plane, z along
// its normal. The squared distance of a point (x, y, z) is
//
//     z^2                               if (x, y) is inside, left of all three edges;
//     z^2 + the least of e_1, e_2, e_3  otherwise; e_i is the squared distance from (x, y) to edge i.
//
// Let t be the coordinate along an edge of length L, and s the distance from its line. Then
// e = (t - clamp(t, 0, L))^2 + s^2. For edge a b, t = x and s = y; for the others, t and s are affine in x
// and y. Rounding may misclassify an (x, y) near an edge, where both formulas give the same result.

/// Accepts any triangle whose longest side is at most about 1. A triangle without area becomes its longest
/// edge or a point. Writes the origin of the triangle's coordinates.
DistanceTriangle<double> distance_triangle(const std::array<Vec3, 3>& corners, Vec3& origin);

DistanceTriangle<float> in_float(const DistanceTriangle<double>& triangle);

/// Returns the shift that converts the products axes . point to coordinates of a triangle with this origin.
Vec3 shift_of(const DistanceTriangle<double>& triangle, const Vec3& origin);

/// weights[i] = w_i / sum of w_j, where w is 1 over the squared distance. Weights are in [0, 1] and sum to 1.
/// Only ratios of distances are used, so no length scale overflows. Distances below cage.contact are raised
/// to it: at a point on the cage, the touching elements get equal weights and all others nearly 0. weights
/// has one entry per element of this kind. Elements without extent (see HandleShape) get 0.
void inverse_distance_weights(const Cage& cage, const mesh::Point& p, std::span<double> weights,
                              Elements elements = Elements::face);

/// The geometry of a handle, for distances.
struct HandleShape {
  mesh::Triangle corners;  ///< for a vertex, the same index three times
  bool weighs;             ///< false for faces without area and vertices without polygons
};
HandleShape handle_shape(const Cage& cage, Elements elements, std::size_t handle);

/// x - sum w h for a vertex at rest position x. It is rounded as in blend(), so that a cage at rest
/// reproduces x to the last bit. Rounding errors of x itself become 0, because they would not shrink with the
/// pose. handles (the h) and x must be relative to the same origin.
Vec3 rest_offset(const Cage& cage, std::span<const Vec3> handles, const Vec3& x,
                 std::span<const double> weights);

/// The fraction of its motion that a point makes if its weights sum to `total` before normalisation. It is 1
/// for totals above 1, and less for points that are only within the margins of a few elements.
inline double share_of_motion(double total) {
  return std::min(total, 1.0);
}

/// weights[i] = w_i / t, where t is the sum of all w_i and
///
///     w = (1 - d / r)^2 if d < r, otherwise 0.
///
/// d is the exact unsigned distance to the handle. r is the radius; weighting.radius is in diagonals of the
/// cage. Returns t; the point's share is share_of_motion(t). If no handle is within the radius, t and all
/// weights are 0. weights has one entry per handle. Handles without extent (see HandleShape) get 0.
double cut_off_weights(const Cage& cage, const mesh::Point& p, const Weighting& weighting,
                       std::span<double> weights);

/// Mean value weights of the cage's vertices at p, with sum 1. Positions blended with them reproduce affine
/// Mean value weights of the cage's vertices at p, with sum 1. Positions blended with them reproduce affine
/// poses of closed cages. Each triangle's mean vector, the integral of the unit directions that it covers, is
/// split along the directions to its corners. Over a closed cage the mean vectors cancel, so the weights
/// reproduce p (Ju, Schaefer, Warren 2005; Floater, Kos, Reimers 2005). Nearer to the cage than cage.contact,
/// the weights are barycentric. If their sum vanishes (outside, or for open cages), writes the weights of the
/// closest point of the cage and returns false. weights has one entry per vertex. Thread-safe.
bool mean_value_weights(const Cage& cage, const mesh::Point& p, std::span<double> weights);

}  // namespace viete::deform
