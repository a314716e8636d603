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
// Let t be the coordinate along an edge of length L, and s the distance from its line. With these numbers, e
// = (t - clamp(t, 0, L))^2 + s^2. For edge a b, t = x and s = y; for other edges, t and s are affine in x and
// y. Rounding can choose the wrong formula only near an edge, where the two formulas agree.

/// Converts a triangle, whose longest side must be at most about 1, and writes the origin of its coordinates.
/// A triangle without area becomes its longest edge or a point.
DistanceTriangle<double> distance_triangle(const std::array<Vec3, 3>& corners, Vec3& origin);

DistanceTriangle<float> in_float(const DistanceTriangle<double>& triangle);

/// Returns the shift that converts the products axes . point to coordinates of a triangle with this origin.
Vec3 shift_of(const DistanceTriangle<double>& triangle, const Vec3& origin);

/// Sets weights[i] = w_i / sum of w_j, where w is 1 / (squared distance). Weights are in [0, 1] and sum to 1.
/// Uses only ratios of distances, so no length scale overflows. Distances below cage.contact count as
/// cage.contact. At a point on the cage, touching elements get equal weights, and other elements get nearly
/// 0. weights has one entry per handle. Elements without extent (see HandleShape) get 0.
void inverse_distance_weights(const Cage& cage, const mesh::Point& p, std::span<double> weights,
                              Elements elements = Elements::face);

/// The geometry of a handle, for distances.
struct HandleShape {
  mesh::Triangle corners;  ///< for a vertex, the same index three times
  bool weighs;             ///< false for faces without area and vertices without polygons
};
HandleShape handle_shape(const Cage& cage, Elements elements, std::size_t handle);

/// Returns x - sum w h for a vertex at the rest position x. Rounds as blend() does, so that a cage at rest
/// reproduces all bits of x. If the result is only a rounding error, returns 0, because the error would not
/// shrink with the pose. handles (the h) and x must be relative to one origin.
Vec3 rest_offset(const Cage& cage, std::span<const Vec3> handles, const Vec3& x,
                 std::span<const double> weights);

/// Returns how much of the blended motion a point follows, 0 to 1. `total` is the sum of its weights before
/// normalisation. This sum is less than 1 if all elements are almost a radius away.
inline double share_of_motion(double total) {
  return std::min(total, 1.0);
}

/// Sets weights[i] = w_i / t, where t is the sum of all w_i and
///
///     w = (1 - d / r)^2 if d < r, otherwise 0.
///
/// d is the exact unsigned distance to the handle. r is the radius, weighting.radius times cage.size. Returns
/// t. The point's share is share_of_motion(t). If no handle is within the radius, t and all weights are 0.
/// weights has one entry per handle. Handles without extent (see HandleShape) get 0.
double cut_off_weights(const Cage& cage, const mesh::Point& p, const Weighting& weighting,
                       std::span<double> weights);

/// Computes mean value weights of the cage's vertices at p, with sum 1. With these weights, blended positions
/// reproduce affine poses of closed cages. Each triangle's mean vector, the integral of the unit directions
/// that it covers, is split along the directions to its corners. Over a closed cage the mean vectors cancel,
/// so the weights reproduce p (Ju, Schaefer, Warren 2005; Floater, Kos, Reimers 2005). If p is nearer to the
/// cage than cage.contact, the weights are barycentric. If the sum of the weights vanishes (possible outside,
/// or for open cages), writes the weights of the cage's closest point and returns false. weights.size() ==
/// vertices. Thread-safe.
bool mean_value_weights(const Cage& cage, const mesh::Point& p, std::span<double> weights);

}  // namespace viete::deform
