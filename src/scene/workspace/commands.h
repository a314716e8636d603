// Everything a user can do by name: one list for keys, buttons, menus, help and tests.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "scene/workspace/command.h"
#include "scene/workspace/workspace.h"

namespace viete::scene {

/// "way_paper", "elements_face", "weights_mean_value": of the command that chooses it.
std::string choice_command_name(deform::Way way);
std::string choice_command_name(deform::Elements elements);
std::string choice_command_name(deform::Weights weights);
std::string choice_command_name(deform::Blend blend);

}  // namespace viete::scene
