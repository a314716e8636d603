// The command tables, one per topic. A new command is one row.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/workspace/command.h"

namespace viete::scene {

/// Rows in the order of the command reference.
class CommandTable {
public:
  /// For the rows that follow.
  void heading(std::string_view group) { group_ = group; }

  /// Returns the row for chained calls; valid until the next one is added.
  Command& add(std::string name, Label label, std::string hint, const Condition& enabled, Effect effect) {
    return add(std::move(name), std::move(label), std::move(hint), Shortcut{}, enabled, std::move(effect));
  }
  Command& add(std::string name, Label label, std::string hint, Shortcut shortcut, const Condition& enabled,
               Effect effect) {
    return rows_.emplace_back(Command{std::move(effect), std::move(name), std::move(label.words),
                                      std::move(label.brief), std::move(hint), enabled, group_, shortcut});
  }
  /// One of several exclusive values, in its own submenu; elsewhere the submenu's title precedes the label.
  void choice(std::string name, std::string_view submenu, std::string_view label, std::string_view hint,
              const Condition& enabled, Effect effect) {
    const std::string brief(label);
    add(std::move(name), {std::string(submenu) + ": " + brief, brief}, std::string(hint), enabled,
        std::move(effect))
        .under(submenu);
  }

  const std::vector<Command>& rows() const { return rows_; }

private:
  std::string_view group_;
  std::vector<Command> rows_;
};

void add_file_commands(CommandTable& table);
void add_select_commands(CommandTable& table);  ///< and undo
void add_cage_commands(CommandTable& table);
void add_tool_commands(CommandTable& table);  ///< and probes
void add_blend_commands(CommandTable& table);
void add_camera_commands(CommandTable& table);  ///< and bookmarks
void add_view_commands(CommandTable& table);    ///< display options
void add_map_commands(CommandTable& table);
void add_split_commands(CommandTable& table);
void add_help_commands(CommandTable& table);
void add_hand_commands(CommandTable& table);
void add_time_commands(CommandTable& table);            ///< named poses and timeline
void add_animation_file_commands(CommandTable& table);  ///< files of both

}  // namespace viete::scene
