// The menus, and the search for commands.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "workspace/command.h"

namespace viete::workspace {

struct Menu {
  std::string_view title;
  std::vector<const Command*> items;  ///< in command order
};

/// The menus in the order of the menu bar. Every command is in one menu.
std::span<const Menu> menus();

/// True for the first command after a separator in a menu.
bool begins_section(const Command& command);

/// The commands that match all typed words, with the best match first. Without text, all commands. Omits
/// disabled commands for which Effect::passing is true.
std::vector<const Command*> find_commands(const Workspace& workspace, std::string_view typed);

}  // namespace viete::workspace
