// The commands by menus, and found by a few letters of them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/workspace/command.h"

namespace viete::scene {

struct Menu {
  std::string_view title;
  std::vector<const Command*> items;  ///< in the order of the commands
};

/// Every command in one of them, in the order of the menu bar.
std::span<const Menu> menus();

/// The commands that fit what was typed, best first: its words begin words of theirs, or stand in them, or
/// their letters do in order. All that are no passing ones for nothing typed.
std::vector<const Command*> find_commands(const Workspace& workspace, std::string_view typed);

}  // namespace viete::scene
