// The dragon's spine: the curve from the tip of the tail to the back of the head that everything else hangs
// on.
#pragma once

#include <vector>

#include "dragon/tube.h"

namespace viete::dragon {

const std::vector<Station>& spine();

/// Relief of the legs: scales that fade out towards the thin shank.
double leg_scales(const TubePoint& p);

/// The spine's own direction of "sideways": left of the dragon is +z.
inline constexpr Vec3 kSideways{0, 0, 1};

}  // namespace viete::dragon
