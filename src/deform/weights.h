// Weights of cage elements at a point: 1/d^2 by exact two-sided distance.
#pragma once

#include <span>

#include "deform/cage.h"

namespace viete::deform {

/// weights[i] = d_i^-2 / sum of d_j^-2: each in [0, 1], sum 1. Formed from ratios of distances, so that
/// nothing overflows at any length scale; distances below cage.contact count as that, so that a point on
/// elements has the limit: equal shares of the elements touched, the rest next to nothing. Elements without
/// area get 0. weights.size() == cage.element_count().
void inverse_distance_weights(const Cage& cage, const mesh::Point& p, std::span<double> weights);

}  // namespace viete::deform
