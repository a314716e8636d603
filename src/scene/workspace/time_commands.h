// Commands for named poses and the timeline.
#pragma once

#include <functional>

#include "scene/workspace/workspace.h"

namespace viete::scene {

/// Stops playback and runs the change; shows a message if it would exceed the drawable range.
void change_mix(Workspace& workspace, const std::function<bool()>& change);

}  // namespace viete::scene
