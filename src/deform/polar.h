// A 3x3 matrix split into rotation and stretch, M = R S.
#pragma once

#include "deform/cage.h"
#include "sym3/rotation.h"
#include "sym3/sym3.h"

namespace viete::deform {

/// M = rotation * axes diag(stretches) axes^T.
struct Polar {
  sym3::Mat3<double> rotation;  ///< proper, entries by rows
  sym3::Mat3<double> axes;      ///< columns are the directions of stretch at rest
  Vec3 stretches;               ///< descending, not negative
};

/// By singular values (M = U diag V^T, R = U V^T). det M < 0: the closest proper rotation, the smallest
/// singular vector flipped. M = 0 gives R = I.
Polar polar(const sym3::Mat3<double>& m);

/// X = axes diag(log stretches) axes^T. The stretches must be positive.
sym3::Sym3<double> log_stretch(const Polar& polar);

}  // namespace viete::deform
