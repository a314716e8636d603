// A command: what a user can do by name. The table of all is made in commands.cpp.
#pragma once

#include <span>
#include <string>
#include <string_view>

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
struct Label : std::string_view {
  constexpr Label(const char* words) : Label(std::string_view(words)) {}
  constexpr Label(std::string_view words) : Label(words, words) {}
  constexpr Label(std::string_view words, std::string_view under_headline)
      : std::string_view(words), brief(under_headline) {}

  std::string_view brief;  ///< "Front", under "Look from"
};

struct Command {
  std::string_view name;  ///< stable, for scripts and tests: "undo"
  Label label;
  std::string_view hint;   ///< one sentence: what it does
  std::string_view group;  ///< heading in the help
  Shortcut shortcut, alternative;
  Condition enabled;
  void (*run)(Workspace&);
};

/// In the order of the help.
std::span<const Command> commands();

/// nullptr if there is none of that name.
const Command* find_command(std::string_view name);

}  // namespace viete::scene
