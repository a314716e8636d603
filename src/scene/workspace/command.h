// A command: what a user can do by name. The table of all is made in commands.cpp.
#pragma once

#include <concepts>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "scene/workspace/shortcut.h"

namespace viete::scene {

struct Workspace;

/// When a command can run, and what to do first where it cannot.
struct Condition {
  bool (*holds)(const Workspace&);
  std::string_view otherwise;
  bool operator()(const Workspace& workspace) const { return holds(workspace); }
};

/// What a command is called: words that are understood by themselves, and fewer where a headline says the
/// rest.
struct Label {
  Label(const char* words) : words(words), brief(words) {}
  Label(std::string words, std::string under_headline)
      : words(std::move(words)), brief(std::move(under_headline)) {}

  std::string words, brief;
};

/// What a command does.
struct Effect {
  template <std::invocable<Workspace&> Run>
  Effect(Run run) : run(std::move(run)) {}
  /// Of one that switches something, which says whether that is on.
  Effect(std::function<void(Workspace&)> run, std::function<bool(const Workspace&)> is_on)
      : run(std::move(run)), is_on(std::move(is_on)) {}

  std::function<void(Workspace&)> run;
  std::function<bool(const Workspace&)> is_on{};
  bool passing = false;  ///< it answers something that comes and goes (Cancel, Later): shown while it can run
};

inline Effect passing(Effect effect) {
  effect.passing = true;
  return effect;
}

struct Command : Effect {
  std::string name;   ///< stable, for keys and tests: "undo"
  std::string label;  ///< "Look from the front"
  std::string brief;  ///< "Front", under "Look from"
  std::string hint;   ///< one sentence: what it does
  Condition enabled;
  std::string_view group{};  ///< heading in the help
  Shortcut shortcut{}, alternative{};
  std::string_view submenu{};                          ///< where commands of one choice share one
  std::string (*subject)(const Workspace&) = nullptr;  ///< what it acts on now: "Rotate" of "Undo"

  /// "Undo Rotate", or `called` instead of the label.
  std::string label_now(const Workspace& workspace, std::string_view called) const;
  std::string label_now(const Workspace& workspace) const { return label_now(workspace, label); }
  bool on(const Workspace& workspace) const { return is_on && is_on(workspace); }

  // What a row of a table says besides.
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

/// In the order of the help.
std::span<const Command> commands();

/// nullptr if there is none of that name.
const Command* find_command(std::string_view name);

}  // namespace viete::scene
