// Commands that choose one of several: their names, and rows of them.
#pragma once

#include <algorithm>
#include <string>

#include "deform/ways.h"
#include "scene/document/handling.h"
#include "scene/document/timeline.h"
#include "scene/document/view_options.h"
#include "scene/workspace/command_tables.h"
#include "scene/workspace/keymap.h"

namespace viete::scene {

// What the names of these commands begin with.
constexpr const char* prefix_of(deform::Way) {
  return "way_";
}
constexpr const char* prefix_of(deform::Elements) {
  return "elements_";
}
constexpr const char* prefix_of(deform::Weights) {
  return "weights_";
}
constexpr const char* prefix_of(deform::Blend) {
  return "blend_";
}
constexpr const char* prefix_of(Pivot) {
  return "pivot_";
}
constexpr const char* prefix_of(Axes) {
  return "axes_";
}
constexpr const char* prefix_of(MirrorPlane) {
  return "mirror_";
}
constexpr const char* prefix_of(SoftCurve) {
  return "soft_";
}
constexpr const char* prefix_of(SoftDistance) {
  return "soft_";
}
constexpr const char* prefix_of(Repeat) {
  return "repeat_";
}
constexpr const char* prefix_of(Easing) {
  return "easing_";
}
constexpr const char* prefix_of(Shading) {
  return "shading_";
}
constexpr const char* prefix_of(KeyPreset) {
  return "keys_";
}

/// "way_paper", "pivot_median": of the command that chooses it.
template <class Value>
std::string choice_command_name(Value value) {
  std::string name = prefix_of(value);
  if constexpr (requires { choices(value); }) {
    name += entry_of(value).word;
  } else {
    name += deform::entry(value).name;
  }
  std::ranges::replace(name, '-', '_');
  return name;
}

/// A row for each value, which `choose` takes.
template <class Value>
void add_choices(CommandTable& table, std::string_view headline, const Condition& enabled,
                 void (*choose)(Workspace&, Value)) {
  int number = 0;
  for (const Choice& entry : choices(Value{})) {
    const auto value = static_cast<Value>(number++);
    table.choice(choice_command_name(value), headline, entry.label, entry.hint, enabled,
                 [=](Workspace& w) { choose(w, value); });
  }
}

}  // namespace viete::scene
