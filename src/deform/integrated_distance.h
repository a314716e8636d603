// Weights of cage elements at a point: |x - y|^-4 integrated over the element, so that they do not depend on
// how the cage is cut into triangles.
//
// With n the unit normal, h the height of x above the plane and, for each edge from u to v of length L (as
// seen from x), m = n . (u x v) / L its distance from the foot of x, positive where the foot is inside, q^2 =
// h^2 + m^2, and b the angle between u and v, tan b = q L / (u . v):
//
//     w = sum over the edges of  m b / (2 h^2 q) (1)
//
// For a foot inside all terms are positive, and this is as accurate as can be. Outside, terms cancel: near
// the plane, where w stays finite as h goes to 0, and far away. Inversion about x shows what is left. It
// scales areas by |x - y|^-4, so that w is an area: that of a triangle on the sphere of diameter 1/h, whose
// sides are arcs of the circles that lines become. This is the triangle with the same corners and sides of
// great circles, and between these and the arcs one sliver an edge. With c = u . v and s = m / q the half of
// the former's angular area is the sum of the angles d, tan d = m L / c = s tan b, thus the argument of the
// product of c + i m L over the edges, whose imaginary part has the factor h^2 in front:
//
//     2 h^2 w = arctan(h^2 X) - sum of (d - s b),      X = T P / Re product, (2) d - s b = h^2 (m / q^3) J,
//     J = integral from 0 to b of sin^2 t / (1 - k sin^2 t) dt,   k = h^2 / q^2
//
// T is twice the area, P the power of x with respect to the sphere about the circumcircle: u . v of any edge
// less m L times the cotangent of the opposite angle. Divided by 2 h^2, nothing cancels that is not small: X
// / 2 is the area over d^4 far away, the rest less by a factor of size over distance. J is a power series in
// k; it converges like (k sin^2 t)^n, which is at most (h / distance)^2 for a foot outside, and (size /
// distance)^2 far away. Where it does not, x is above the triangle or just beside it, and (1) loses nothing.
#pragma once

#include <array>
#include <span>

#include "deform/cage.h"

namespace viete::deform {

/// The integral of (|x - y|^2 + softening^2)^-2 over the triangle, which has area: positive,
/// relative error some 1e-15 and what rounding the height makes of it. softening > 0. Lengths from 1e-18
/// to 1e18.
double inverse_fourth_power_integral(const std::array<Vec3, 3>& corners, const Vec3& x, double softening);

/// 1e-8 diagonals, or the contact where that is more. It changes weights by some 1e-16 a hundredth of the
/// diagonal away from the cage, and on it gives the limit, with as many digits as rounding leaves of which
/// side of an edge a point lies on.
double softening(const Cage& cage);

/// Farther points, in diagonals, have the weights of that distance.
inline constexpr double farthest_weighed = 1e18;

/// weights[i] = w_i / sum of w_j: each in [0, 1], sum 1. Near a face they grow like 1/d^2, far away they are
/// its area over d^4; they add up: the pieces of an element have together what the whole has. With h^2 +
/// softening^2 for h^2 a point on elements has the limit: all of the weight goes to those that are touched,
/// in the ratio of the angles that they fill about the point. Elements without area get 0. Any length scale.
/// weights.size() == cage.element_count().
void integrated_weights(const Cage& cage, const mesh::Point& p, std::span<double> weights);

}  // namespace viete::deform
