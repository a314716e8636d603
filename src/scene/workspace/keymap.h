// Keys, alone and with others held; which key runs which command, and which mouse button turns the view:
// presets for hands from elsewhere, and changes of one's own.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/choice.h"

namespace viete::scene {

/// Keys by name; letters, digits and . , - = / are their capital ASCII character.
enum class Key : int {
  none = 0,
  escape = 256,
  home,
  end,
  page_up,
  page_down,
  delete_key,
  insert,
  enter,
  backspace,
  space,
  up,
  down,
  left,
  right,
  tab,
  f1,
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
  pad0,
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
  pad_plus,
  pad_minus,
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

/// Each once.
std::span<const Key> all_keys();

/// "Ctrl+Shift+Z"; empty for none.
std::string text(const Shortcut& shortcut);
/// What text() says, in any case and order of Ctrl, Shift and Alt; nothing if there is no such key. "" is
/// none.
std::optional<Shortcut> shortcut_of(std::string_view text);

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
