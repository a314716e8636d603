// The commands by menus, and found by a few letters of them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/workspace/commands.h"

namespace viete::scene {

struct Menu {
  std::string_view title;
  std::vector<const Command*> items;  ///< in the order of the commands
};

/// Every command in one of them, in the order of the menu bar.
std::span<const Menu> menus();

/// "Look from", "Unit": commands of one choice share a menu within the menu; empty: it stands there itself.
std::string_view submenu_of(const Command& command);

/// True for what answers something that comes and goes (Cancel, Later): shown while it can be run.
bool is_passing(const Command& command);

/// Of a command that switches something: is it on? Nothing for others.
std::optional<bool> is_on(const Workspace& workspace, const Command& command);

/// The commands that fit what was typed, best first: its words begin words of theirs, or stand in them, or
/// their letters do in order. All that are no passing ones for nothing typed.
std::vector<const Command*> find_commands(const Workspace& workspace, std::string_view typed);

}  // namespace viete::scene
