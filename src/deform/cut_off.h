// Weights that end at a radius: what no element reaches stays at rest.
#pragma once

#include <algorithm>
#include <span>

#include "deform/cage.h"
#include "deform/scheme.h"

namespace viete::deform {

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

}  // namespace viete::deform
