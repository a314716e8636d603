#include "scene/workspace/shortcut.h"

#include <algorithm>
#include <array>
#include <vector>

namespace viete::scene {

namespace {

// Starting at Key::escape.
constexpr std::array key_names = {"Esc",   "Home",      "End",   "Page Up", "Page Down", "Delete",   "Insert",
                                  "Enter", "Backspace", "Space", "Up",      "Down",      "Left",     "Right",
                                  "Tab",   "F1",        "F2",    "F3",      "F4",        "F5",       "F6",
                                  "F7",    "F8",        "F9",    "F10",     "F11",       "F12",      "Num 0",
                                  "Num 1", "Num 2",     "Num 3", "Num 4",   "Num 5",     "Num 6",    "Num 7",
                                  "Num 8", "Num 9",     "Num .", "Num +",   "Num -",     "Num Enter"};
constexpr int first_named = static_cast<int>(Key::escape);
static_assert(first_named + static_cast<int>(key_names.size()) == static_cast<int>(Key::pad_enter) + 1);

bool is_printed(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view(".,-=/").find(c) != std::string_view::npos;
}

char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

bool same_word(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, {}, upper, upper);
}

std::string key_name(Key key) {
  const int code = static_cast<int>(key);
  if (code >= first_named) return key_names[static_cast<std::size_t>(code - first_named)];
  return std::string(1, static_cast<char>(key));
}

std::optional<Key> key_of(std::string_view name) {
  for (std::size_t i = 0; i < key_names.size(); ++i)
    if (same_word(name, key_names[i])) return static_cast<Key>(first_named + static_cast<int>(i));
  if (name.size() != 1 || !is_printed(upper(name[0]))) return std::nullopt;
  return key(upper(name[0]));
}

}  // namespace

std::span<const Key> all_keys() {
  static const std::vector<Key> all = [] {
    std::vector<Key> keys;
    for (std::size_t i = 0; i < key_names.size(); ++i)
      keys.push_back(static_cast<Key>(first_named + static_cast<int>(i)));
    for (int c = 0; c < 128; ++c) {
      if (is_printed(static_cast<char>(c))) keys.push_back(static_cast<Key>(c));
    }
    return keys;
  }();
  return all;
}

std::string text(const Shortcut& shortcut) {
  if (shortcut.key == Key::none) return "";
  return std::string(shortcut.ctrl ? "Ctrl+" : "") + (shortcut.shift ? "Shift+" : "") +
         (shortcut.alt ? "Alt+" : "") + key_name(shortcut.key);
}

std::optional<Shortcut> shortcut_of(std::string_view text) {
  Shortcut shortcut;
  if (text.empty()) return shortcut;
  // The key itself may be a plus, so no part before it is empty.
  for (std::size_t plus = text.find('+'); plus != std::string_view::npos && plus > 0; plus = text.find('+')) {
    const std::string_view held = text.substr(0, plus);
    if (same_word(held, "Ctrl")) {
      shortcut.ctrl = true;
    } else if (same_word(held, "Shift")) {
      shortcut.shift = true;
    } else if (same_word(held, "Alt")) {
      shortcut.alt = true;
    } else {
      break;
    }
    text.remove_prefix(plus + 1);
  }
  const auto found = key_of(text);
  if (!found) return std::nullopt;
  shortcut.key = *found;
  return shortcut;
}

}  // namespace viete::scene
