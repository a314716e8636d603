// The commands sorted into menus, and the search among them.
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

/// In the order of the menu bar; every command is in one menu.
std::span<const Menu> menus();

/// Commands that match the typed text, best first: by the beginnings of words, then within words, then by
/// letters in order. Without text, all except those visible only while they can run.
std::vector<const Command*> find_commands(const Workspace& workspace, std::string_view typed);

}  // namespace viete::workspace
