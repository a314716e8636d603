#include <algorithm>
#include <cctype>

#include "scene/workspace/command_tables.h"

namespace viete::scene {

std::span<const Command> commands() {
  static const CommandTable all = [] {
    CommandTable table;
    for (const auto add :
         {add_file_commands, add_select_commands, add_cage_commands, add_tool_commands, add_blend_commands,
          add_camera_commands, add_view_commands, add_map_commands, add_split_commands, add_help_commands,
          add_hand_commands, add_time_commands, add_animation_file_commands})
      add(table);
    return table;
  }();
  return all.rows();
}

std::string Command::label_now(const Workspace& workspace, std::string_view called) const {
  std::string what = subject ? subject(workspace) : "";
  if (what.empty()) return std::string(called);
  what[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(what[0])));
  return std::string(called) + ' ' + what;
}

const Command* find_command(std::string_view name) {
  const auto all = commands();
  const auto found = std::ranges::find(all, name, &Command::name);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace viete::scene
