// The plane of each wing, which both the wing and its cage are laid out in.
#pragma once

#include "dragon/membrane.h"

namespace viete::dragon {

/// side: +1 for the left wing, -1 for the right one.
WingFrame wing_frame(double side);

}  // namespace viete::dragon
