// The tables of commands, one table per topic. Each command has one row.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "document/handling.h"
#include "document/timeline.h"
#include "document/view_options.h"
#include "pose/deformer.h"
#include "workspace/command.h"
#include "workspace/keymap.h"

namespace viete::workspace {

/// The rows are in the order of the command reference.
class CommandTable {
public:
  /// Sets the heading of the rows that follow.
  void heading(std::string_view group) { group_ = group; }

  /// Adds a row. The reference is valid until the next row is added.
  Command& add(std::string name, Label label, std::string hint, const Condition& enabled, Effect effect) {
    return add(std::move(name), std::move(label), std::move(hint), Shortcut{}, enabled, std::move(effect));
  }
  Command& add(std::string name, Label label, std::string hint, Shortcut shortcut, const Condition& enabled,
               Effect effect) {
    return rows_.emplace_back(Command{std::move(effect), std::move(name), std::move(label.words),
                                      std::move(label.brief), std::move(hint), enabled, group_, shortcut});
  }
  /// Adds a command for one value of a choice, in a submenu. Outside the submenu, the label begins with the
  /// submenu's title.
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
void add_select_commands(CommandTable& table);  ///< selection and undo
void add_cage_commands(CommandTable& table);
void add_tool_commands(CommandTable& table);    ///< tools and probes, in transform_commands.cpp
void add_blend_commands(CommandTable& table);   ///< methods and deformers, in cage_commands.cpp
void add_camera_commands(CommandTable& table);  ///< in view_commands.cpp, as the four below
void add_view_commands(CommandTable& table);    ///< display options
void add_map_commands(CommandTable& table);
void add_split_commands(CommandTable& table);
void add_help_commands(CommandTable& table);
void add_transform_commands(CommandTable& table);
void add_time_commands(CommandTable& table);            ///< named poses and timeline
void add_animation_file_commands(CommandTable& table);  ///< in file_commands.cpp

/// The names of the commands that choose a value of this type begin with this prefix, for example "pivot_".
template <class Value>
constexpr const char* choice_prefix() {
  if constexpr (std::is_same_v<Value, pose::Preset>) return "deformer_";
  if constexpr (std::is_same_v<Value, pose::Weights>) return "weights_";
  if constexpr (std::is_same_v<Value, pose::Blend>) return "blend_";
  if constexpr (std::is_same_v<Value, document::Pivot>) return "pivot_";
  if constexpr (std::is_same_v<Value, document::Axes>) return "axes_";
  if constexpr (std::is_same_v<Value, document::MirrorPlane>) return "mirror_";
  if constexpr (std::is_same_v<Value, document::SoftCurve>) return "soft_";
  if constexpr (std::is_same_v<Value, document::SoftDistance>) return "soft_";
  if constexpr (std::is_same_v<Value, document::Repeat>) return "repeat_";
  if constexpr (std::is_same_v<Value, document::Easing>) return "easing_";
  if constexpr (std::is_same_v<Value, document::Shading>) return "shading_";
  if constexpr (std::is_same_v<Value, analysis::Field>) return "map_";
  if constexpr (std::is_same_v<Value, KeyPreset>) return "keys_";
}

/// The name of the command that chooses the value: "deformer_paper", "pivot_median".
template <class Value>
std::string choice_command_name(Value value) {
  std::string name = choice_prefix<Value>();
  name += base::entry_of(value).word;
  std::ranges::replace(name, '-', '_');
  return name;
}

/// Adds a command for each value. The command calls `choose` with the value.
template <class Value>
void add_choices(CommandTable& table, std::string_view headline, const Condition& enabled,
                 void (*choose)(Workspace&, Value)) {
  int number = 0;
  for (const base::Choice& entry : choices(Value{})) {
    const auto value = static_cast<Value>(number++);
    table.choice(choice_command_name(value), headline, entry.label, entry.hint, enabled,
                 [=](Workspace& w) { choose(w, value); });
  }
}

}  // namespace viete::workspace
