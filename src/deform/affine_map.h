// The affine map of one element of the cage, rest to posed.
#pragma once

#include "mesh/vector.h"
#include "sym3/rotation.h"

namespace viete::deform {

/// x' = linear (x - c) + center + origin, c the element's rest centre. Entries of linear by rows.
struct AffineMap {
  sym3::Mat3<double> linear;
  mesh::Vec3 center;  ///< posed centre minus the pose's origin
};

}  // namespace viete::deform
