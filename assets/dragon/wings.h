// The plane of each wing, which both the wing and its cage are laid out in.
#pragma once

#include <vector>

#include "dragon/membrane.h"
#include "dragon/tube.h"

namespace viete::dragon {

/// side: +1 for the left wing, -1 for the right one.
WingFrame wing_frame(double side);

/// Its bones: from the shoulder over the elbow to the wrist, and from there to the tips of the fingers.
inline constexpr int kFingers = 4;
std::vector<Station> wing_arm(const WingFrame& frame);
std::vector<Station> wing_finger(const WingFrame& frame, int i);

}  // namespace viete::dragon
