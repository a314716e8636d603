// The lines that the dragon's body is laid along, and its skeleton: the spine, from the tip of the tail to
// the back of the head, and what hangs on it.
#pragma once

#include <vector>

#include "dragon/tube.h"

namespace viete::dragon {

const std::vector<Station>& spine();

/// From hip or shoulder to the heel, which stands a little above the ground; side: +1 for the left one.
std::vector<Station> leg(bool hind, double side);

/// The end of the jaws, between them; the long horn.
Station muzzle();
std::vector<Station> horn(double side);

/// Relief of the legs: scales that fade out towards the thin shank.
double leg_scales(const TubePoint& p);

/// The spine's own direction of "sideways": left of the dragon is +z.
inline constexpr Vec3 kSideways{0, 0, 1};

}  // namespace viete::dragon
