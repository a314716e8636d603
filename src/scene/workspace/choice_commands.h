// Commands that select one of several values: their names and table rows.
#pragma once

#include <algorithm>
#include <string>
#include <type_traits>

#include "deform/scheme.h"
#include "scene/document/handling.h"
#include "scene/document/timeline.h"
#include "scene/document/view_options.h"
#include "scene/workspace/command_tables.h"
#include "scene/workspace/keymap.h"

namespace viete::scene {

/// The prefix of the command names.
template <class Value>
constexpr const char* choice_prefix() {
  if constexpr (std::is_same_v<Value, deform::Way>) return "way_";
  if constexpr (std::is_same_v<Value, deform::Weights>) return "weights_";
  if constexpr (std::is_same_v<Value, deform::Blend>) return "blend_";
  if constexpr (std::is_same_v<Value, Pivot>) return "pivot_";
  if constexpr (std::is_same_v<Value, Axes>) return "axes_";
  if constexpr (std::is_same_v<Value, MirrorPlane>) return "mirror_";
  if constexpr (std::is_same_v<Value, SoftCurve>) return "soft_";
  if constexpr (std::is_same_v<Value, SoftDistance>) return "soft_";
  if constexpr (std::is_same_v<Value, Repeat>) return "repeat_";
  if constexpr (std::is_same_v<Value, Easing>) return "easing_";
  if constexpr (std::is_same_v<Value, Shading>) return "shading_";
  if constexpr (std::is_same_v<Value, lab::Field>) return "map_";
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

}  // namespace viete::scene
