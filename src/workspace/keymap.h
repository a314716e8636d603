// Keyboard shortcuts and mouse buttons: presets known from other programs, and the user's changes.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/choice.h"
#include "workspace/shortcut.h"

namespace viete::workspace {

using base::Choice, base::entry_of, base::next_choice, base::value_of_word;

struct Command;

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
