// Commands: user actions with a name, their menus, and the search for commands.
#pragma once

#include <concepts>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "workspace/shortcut.h"

namespace viete::workspace {

struct Workspace;

/// The advice that is shown if a command cannot run, and the condition for running it.
struct Condition {
  std::string_view otherwise;
  bool (*holds)(const Workspace&);
  bool operator()(const Workspace& workspace) const { return holds(workspace); }
};

/// The label of a command. `brief` is a shorter label for use under a heading.
struct Label {
  Label(const char* words) : words(words), brief(words) {}
  Label(std::string words, std::string under_headline)
      : words(std::move(words)), brief(std::move(under_headline)) {}

  std::string words, brief;
};

struct Effect {
  template <std::invocable<Workspace&> Run>
  Effect(Run run) : run(std::move(run)) {}
  /// A toggle; is_on() returns its state.
  Effect(std::function<void(Workspace&)> run, std::function<bool(const Workspace&)> is_on)
      : run(std::move(run)), is_on(std::move(is_on)) {}

  std::function<void(Workspace&)> run;
  std::function<bool(const Workspace&)> is_on{};
  bool passing = false;  ///< true: the command, such as Cancel, is visible only while the command can run
};

inline Effect passing(Effect effect) {
  effect.passing = true;
  return effect;
}

struct Command : Effect {
  std::string name;   ///< fixed identifier for keys and tests: "undo"
  std::string label;  ///< full label: "View from the front"
  std::string brief;  ///< label under the heading "Viewpoint": "Front"
  std::string hint;   ///< one sentence about the effect
  Condition enabled;
  std::string_view group{};  ///< heading in the command reference
  Shortcut shortcut{}, alternative{};
  std::string_view submenu{};                          ///< title of the submenu; empty: no submenu
  std::string (*subject)(const Workspace&) = nullptr;  ///< appended to the label: "Rotate" in "Undo Rotate"

  /// The label followed by the result of subject(): "Undo Rotate". `called` replaces the label.
  std::string label_now(const Workspace& workspace, std::string_view called) const;
  std::string label_now(const Workspace& workspace) const { return label_now(workspace, label); }
  bool on(const Workspace& workspace) const { return is_on && is_on(workspace); }

  // Optional fields, set with chained calls in a table row.
  Command& or_by(Shortcut other) {
    alternative = other;
    return *this;
  }
  Command& of(std::string (*what)(const Workspace&)) {
    subject = what;
    return *this;
  }
  Command& under(std::string_view menu) {
    submenu = menu;
    return *this;
  }
};

/// All commands, in the order of the command reference.
std::span<const Command> commands();

/// nullptr if there is no command of that name.
const Command* find_command(std::string_view name);

struct Menu {
  std::string_view title;
  std::vector<const Command*> items;  ///< in command order
};

/// The menus in the order of the menu bar. Every command is in one menu.
std::span<const Menu> menus();

/// True for the first command after a separator in a menu.
bool begins_section(const Command& command);

/// The commands that match all typed words, with the best match first. Without text, all commands. Omits
/// disabled commands for which Effect::passing is true.
std::vector<const Command*> find_commands(const Workspace& workspace, std::string_view typed);

}  // namespace viete::workspace
