// Lists of commands that choose a value, with tooltips.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>

#include "ui/context.h"
#include "ui/widgets.h"
#include "workspace/command_tables.h"

namespace viete::ui {

struct ChoiceListWords {
  const char* prefix = "";  ///< prefix of the entries' widget names, for tests
  const char* none = "";    ///< text shown if no value is chosen
  const char* about = "";   ///< tooltip that replaces the value's tooltip
};

/// A drop-down list of all values, with the current value marked.
template <class Value>
void choice_list(const Context& ui, const std::string& name, std::optional<Value> now, float width,
                 const ChoiceListWords& words = {}) {
  ImGui::SetNextItemWidth(width);
  const char* const shown = now ? base::entry_of(*now).label.data() : words.none;
  const std::string about = *words.about || !now ? words.about : std::string(base::entry_of(*now).hint);
  if (!begin_list(ui, name, shown, about)) return;
  const std::span<const base::Choice> all = choices(Value{});
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto value = static_cast<Value>(i);
    const workspace::Command& command = *workspace::find_command(workspace::choice_command_name(value));
    if (list_entry(ui, all[i].label, words.prefix + command.name, value == now, all[i].hint) &&
        command.enabled(ui.workspace))
      command.run(ui.workspace);
  }
  ImGui::EndCombo();
}

/// Like choice_list(), without commands. Returns the newly chosen value, or nullopt.
template <class Value>
std::optional<Value> entry_list(const Context& ui, const std::string& name, std::optional<Value> now,
                                const char* none = "") {
  std::optional<Value> chosen;
  const char* const shown = now ? base::entry_of(*now).label.data() : none;
  if (!begin_list(ui, name, shown, now ? std::string(base::entry_of(*now).hint) : "")) return chosen;
  for (const Value value : base::all_values<Value>()) {
    const base::Choice& entry = base::entry_of(value);
    if (list_entry(ui, entry.label, name + '_' + std::string(entry.word), value == now, entry.hint))
      chosen = value;
  }
  ImGui::EndCombo();
  return chosen;
}

}  // namespace viete::ui
