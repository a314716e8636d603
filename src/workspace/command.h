// Commands: user actions with a name. Their menus, and their keys: presets known from other programs, and the
// user's changes.
#pragma once

#include <concepts>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/choice.h"

namespace viete::workspace {

struct Workspace;

/// Key codes with GLFW's numbers. Uppercase letters, digits and . , - = / have their ASCII code.
enum class Key : int {
  none = 0,
  space = 32,
  escape = 256,
  enter,
  tab,
  backspace,
  insert,
  delete_key,
  right,
  left,
  down,
  up,
  page_up,
  page_down,
  home,
  end,
  f1 = 290,
  f2,
  f3,
  f4,
  f5,
  f6,
  f7,
  f8,
  f9,
  f10,
  f11,
  f12,
  pad0 = 320,
  pad1,
  pad2,
  pad3,
  pad4,
  pad5,
  pad6,
  pad7,
  pad8,
  pad9,
  pad_point,
  pad_minus = 333,
  pad_plus,
  pad_enter,
};

constexpr Key key(char c) {
  return static_cast<Key>(c);
}

struct Shortcut {
  Key key = Key::none;
  bool ctrl = false, shift = false, alt = false;

  friend bool operator==(const Shortcut&, const Shortcut&) = default;
};

std::span<const std::pair<Key, std::string>> all_keys();

/// "Ctrl+Shift+Z"; empty for Key::none.
std::string text(const Shortcut& shortcut);
/// Parses the result of text(); ignores case and the order of modifiers. Nullopt for an unknown key.
std::optional<Shortcut> shortcut_of(std::string_view text);

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

using base::Choice, base::entry_of, base::next_choice, base::value_of_word;

enum class KeyPreset { viete, blender, maya, viewer };
std::span<const Choice> choices(KeyPreset);

struct Shortcuts {
  Shortcut first, second;
};
/// "Ctrl+A, A".
std::string text(const Shortcuts& keys);

/// The keys of all commands. A key belongs to only one command, unless shares_keys() is true.
class Keymap {
public:
  using Changes = std::map<std::string, Shortcut, std::less<>>;  ///< by command name

  Keymap() { resolve(); }

  KeyPreset preset() const { return preset_; }
  /// Changes the preset; keeps the user's changes.
  void set_preset(KeyPreset preset);

  const Changes& changes() const { return changes_; }
  /// Makes this key the command's only key. Commands in losers() no longer have it. Key::none removes all
  /// keys.
  void change(std::string_view command, const Shortcut& shortcut);
  /// Removes the user's change of a command, so that the command has the preset's keys.
  void take_back(std::string_view command);
  void put(Changes changes);

  Shortcuts of(const Command& command) const;
  /// The commands that have this key.
  std::vector<const Command*> commands_of(const Shortcut& shortcut) const;

  /// The commands that lose the key if it is assigned to `command`.
  std::vector<const Command*> losers(std::string_view command, const Shortcut& shortcut) const;

  /// True if dragging the background with the left button orbits the camera.
  bool left_orbits() const { return preset_ == KeyPreset::viewer; }
  /// True if, with Alt, the middle button pans and the right button zooms.
  bool alt_moves_camera() const { return preset_ == KeyPreset::maya; }

  friend bool operator==(const Keymap& a, const Keymap& b) {
    return a.preset_ == b.preset_ && a.changes_ == b.changes_;
  }

private:
  void resolve();
  void give(std::string_view command, const Shortcuts& shortcuts);

  KeyPreset preset_ = KeyPreset::viete;
  Changes changes_;
  std::map<std::string_view, Shortcuts> keys_;  // by command name
};

/// True if both commands can have the same key, because the commands apply in different modes.
bool shares_keys(std::string_view command, std::string_view other);

}  // namespace viete::workspace
