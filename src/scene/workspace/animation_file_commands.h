// Commands that read and write poses and animations.
#pragma once

#include <vector>
#include "scene/workspace/command.h"

namespace viete::scene {

/// In the order of the help.
std::vector<Command> animation_file_commands();

}  // namespace viete::scene
