// Weights of faces or vertices at a point: 1/d^2 by exact two-sided distance.
#pragma once

#include <span>

#include "deform/cage.h"
#include "deform/scheme.h"

namespace viete::deform {

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

}  // namespace viete::deform
