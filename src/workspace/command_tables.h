// The command tables, one per topic. A new command is one row; a choice is a row for each of its values.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "deform/scheme.h"
#include "document/handling.h"
#include "document/timeline.h"
#include "document/view_options.h"
#include "workspace/command.h"
#include "workspace/keymap.h"

namespace viete::workspace {

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

/// The prefix of the command names.
template <class Value>
constexpr const char* choice_prefix() {
  if constexpr (std::is_same_v<Value, deform::Way>) return "way_";
  if constexpr (std::is_same_v<Value, deform::Weights>) return "weights_";
  if constexpr (std::is_same_v<Value, deform::Blend>) return "blend_";
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

/// "way_paper", "pivot_median": the name of the command that selects the value.
template <class Value>
std::string choice_command_name(Value value) {
  std::string name = choice_prefix<Value>();
  if constexpr (requires { choices(value); }) {
    name += entry_of(value).word;
  } else {
    name += deform::entry(value).name;
  }
  std::ranges::replace(name, '-', '_');
  return name;
}

/// Adds a row for each value; the command calls `choose` with it.
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
