// Keys with modifiers.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace viete::workspace {

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

}  // namespace viete::workspace
