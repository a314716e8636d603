// Keys with modifiers.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace viete::scene {

/// Named keys. The value of letters (uppercase), digits and . , - = / is their ASCII code.
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

/// Each key once.
std::span<const Key> all_keys();

/// "Ctrl+Shift+Z"; empty for Key::none.
std::string text(const Shortcut& shortcut);
/// Parses the format of text(), in any case and order of Ctrl, Shift and Alt; nullopt for an unknown key. ""
/// is Key::none.
std::optional<Shortcut> shortcut_of(std::string_view text);

}  // namespace viete::scene
