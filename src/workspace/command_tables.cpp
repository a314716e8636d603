#include "workspace/command_tables.h"

namespace viete::workspace {

std::span<const Command> commands() {
  static const CommandTable all = [] {
    CommandTable table;
    for (const auto add :
         {add_file_commands, add_select_commands, add_cage_commands, add_tool_commands, add_blend_commands,
          add_camera_commands, add_view_commands, add_map_commands, add_split_commands, add_help_commands,
          add_transform_commands, add_time_commands, add_animation_file_commands})
      add(table);
    return table;
  }();
  return all.rows();
}

}  // namespace viete::workspace
