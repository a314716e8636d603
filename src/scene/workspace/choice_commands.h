// Commands that select one of several values: their names and table rows.
#pragma once

#include <algorithm>
#include <string>

#include "deform/scheme.h"
#include "scene/document/handling.h"
#include "scene/document/timeline.h"
#include "scene/document/view_options.h"
#include "scene/workspace/command_tables.h"
#include "scene/workspace/keymap.h"

namespace viete::scene {

/// The prefix of the command names.
template <class Value>
inline constexpr const char* choice_prefix = nullptr;
template <>
inline constexpr const char* choice_prefix<deform::Way> = "way_";
template <>
inline constexpr const char* choice_prefix<deform::Weights> = "weights_";
template <>
inline constexpr const char* choice_prefix<deform::Blend> = "blend_";
template <>
inline constexpr const char* choice_prefix<Pivot> = "pivot_";
template <>
inline constexpr const char* choice_prefix<Axes> = "axes_";
template <>
inline constexpr const char* choice_prefix<MirrorPlane> = "mirror_";
template <>
inline constexpr const char* choice_prefix<SoftCurve> = "soft_";
template <>
inline constexpr const char* choice_prefix<SoftDistance> = "soft_";
template <>
inline constexpr const char* choice_prefix<Repeat> = "repeat_";
template <>
inline constexpr const char* choice_prefix<Easing> = "easing_";
template <>
inline constexpr const char* choice_prefix<Shading> = "shading_";
template <>
inline constexpr const char* choice_prefix<lab::Field> = "map_";
template <>
inline constexpr const char* choice_prefix<KeyPreset> = "keys_";

/// "way_paper", "pivot_median": the name of the command that selects the value.
template <class Value>
std::string choice_command_name(Value value) {
  std::string name = choice_prefix<Value>;
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
