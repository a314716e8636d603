// Mean value coordinates of a closed triangle cage.
#pragma once

#include <span>

#include "deform/cage.h"

namespace viete::deform {

/// Weights of the cage's vertices at p, sum 1: positions blended with them reproduce affine poses of closed
/// cages. Each triangle's mean vector (integral of the unit directions it covers) is split along the
/// directions to its corners; over a closed cage the mean vectors cancel, so the weights reproduce p (Ju,
/// Schaefer, Warren 2005; Floater, Kos, Reimers 2005). On the cage (nearer than cage.contact): barycentric.
/// Where the sum vanishes (it can outside, or for open cages) the coordinates do not exist: the weights of
/// the closest point of the cage, and the answer is false. weights.size() == cage.surface.positions.size().
/// Thread-safe.
bool mean_value_weights(const Cage& cage, const mesh::Point& p, std::span<double> weights);

}  // namespace viete::deform
