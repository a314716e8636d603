// Commands of poses with names, and of time.
#pragma once

#include <functional>

#include "scene/workspace/workspace.h"

namespace viete::scene {

/// Stops playing, mixes, and says so where that would have led too far.
void change_mix(Workspace& workspace, const std::function<bool()>& change);

}  // namespace viete::scene
