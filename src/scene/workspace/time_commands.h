// Commands of poses with names, and of time.
#pragma once

#include <functional>
#include <string>

#include "scene/document/timeline.h"
#include "scene/workspace/workspace.h"

namespace viete::scene {

/// Stops playing, mixes, and says so where that would have led too far.
void change_mix(Workspace& workspace, const std::function<bool()>& change);

/// "repeat_loop", "easing_smooth": of the command that chooses it.
std::string choice_command_name(Repeat);
std::string choice_command_name(Easing);

}  // namespace viete::scene
