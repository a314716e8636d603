// Weights of faces, edges or vertices at a point: 1/d^2 by exact two-sided distance, as far as one reaches.
#pragma once

#include <span>

#include "deform/cage.h"
#include "deform/scheme.h"

namespace viete::deform {

/// weights[i] = w_i / sum of w_j: each in [0, 1], sum 1. Without an end to the reach w = d^-2. Else
///
///     w = d^-2 (1 - d^2 / R^2)^2 where d < R, and 0 beyond,    R = reach D,    D^2 = sum d_j^-6 / sum d_j^-8
///
/// so that an element that is far from p, compared with those that are near, does not move p at all. These
/// are modified Shepard weights (Franke and Nielson, Int. J. Numer. Meth. Eng. 15, 1980, after Franke and
/// Little), but for two things. Their radius is fixed, and a point that no element comes near has no weights;
/// here it goes with D, the mean of squared distances weighted by d^-8, which is the least distance or a
/// little more, so that the nearest element always has weight and lengths have no scale. (The least distance
/// itself would do, but it has a crease wherever another element becomes the nearest, and the model would
/// show it.) And they taper by (1 - d/R)^2, which has no value left half way; this one differs from d^-2 in
/// second order only. Weights are continuous and have continuous derivatives wherever distances do, also
/// where d = R; as the reach grows they become d^-2.
///
/// With another exponent e, d^-2 becomes d^-e; D and the taper stay what they are.
///
/// Formed from ratios of distances, so that nothing overflows at any length scale; distances below
/// cage.contact count as that, so that a point on elements has the limit: equal shares of the elements
/// touched, the rest next to nothing, or nothing. weights.size(): one a handle of that kind; those without
/// extent (see HandleShape) get 0. reach >= lowest_reach, exponent 1 to most_exponent.
void inverse_distance_weights(const Cage& cage, const mesh::Point& p, std::span<double> weights,
                              double reach = whole_cage, Handles handles = Handles::faces, int exponent = 2);

/// Where a handle lies, for distances.
struct HandleShape {
  mesh::Triangle corners;  ///< of an edge its second vertex twice, of a vertex this three times
  bool weighs;             ///< false for faces without area, edges without length, vertices of no polygon
};
HandleShape handle_shape(const Cage& cage, Handles handles, std::size_t handle);

/// Of a vertex at x at rest: x - sum w h, taken as blend() takes it, so that a cage at rest gives x back to
/// the last bits. What is only the rounding of x itself is dropped: it would not shrink with a pose that
/// does. handles and x relative to the same origin.
Vec3 rest_offset(const Cage& cage, std::span<const Vec3> handles, const Vec3& x,
                 std::span<const double> weights);

}  // namespace viete::deform
