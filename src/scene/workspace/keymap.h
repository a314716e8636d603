// Which key runs which command, and which mouse button turns the view: presets for hands from elsewhere, and
// changes of one's own.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/choice.h"
#include "scene/workspace/shortcut.h"

namespace viete::scene {

using base::Choice, base::entry_of, base::next_choice, base::value_of_word;

struct Command;

enum class KeyPreset { viete, blender, maya, viewer };
std::span<const Choice> choices(KeyPreset);

struct Shortcuts {
  Shortcut first, second;
};
/// "Ctrl+A, A".
std::string text(const Shortcuts& keys);

/// A key runs one command, but for some in the mode that edits the cage, see shares_keys(). What a preset or
/// a change gives to a command is taken from others.
class Keymap {
public:
  using Changes = std::map<std::string, Shortcut, std::less<>>;  ///< by the command's name

  Keymap() { resolve(); }

  KeyPreset preset() const { return preset_; }
  /// Own changes stay.
  void set_preset(KeyPreset preset);

  const Changes& changes() const { return changes_; }
  /// This key alone; Key::none: no key.
  void change(std::string_view command, const Shortcut& shortcut);
  /// As the preset has it.
  void take_back(std::string_view command);
  void take_all_back();
  /// Instead of those that there are.
  void put(Changes changes);

  Shortcuts of(const Command& command) const;
  /// All of them that the key may run.
  std::vector<const Command*> commands_of(const Shortcut& shortcut) const;

  /// Who would lose the key to this command.
  std::vector<const Command*> losers(std::string_view command, const Shortcut& shortcut) const;

  /// The left button turns the view where it is pressed on nothing.
  bool left_orbits() const { return preset_ == KeyPreset::viewer; }
  /// With Alt the middle button pans and the right one zooms.
  bool alt_moves_camera() const { return preset_ == KeyPreset::maya; }

  friend bool operator==(const Keymap& a, const Keymap& b) {
    return a.preset_ == b.preset_ && a.changes_ == b.changes_;
  }

private:
  void resolve();
  void give(const Command& command, const Shortcuts& shortcuts);

  KeyPreset preset_ = KeyPreset::viete;
  Changes changes_;
  std::map<std::string_view, Shortcuts> keys_;  // by the command's name
};

/// True if one key may run both, in different modes.
bool shares_keys(std::string_view command, std::string_view other);

}  // namespace viete::scene
