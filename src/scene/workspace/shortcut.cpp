#include "scene/workspace/shortcut.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace viete::scene {

namespace {

constexpr auto key_names = std::to_array<std::pair<Key, std::string_view>>({{Key::escape, "Esc"},
                                                                            {Key::home, "Home"},
                                                                            {Key::end, "End"},
                                                                            {Key::page_up, "Page Up"},
                                                                            {Key::page_down, "Page Down"},
                                                                            {Key::delete_key, "Delete"},
                                                                            {Key::insert, "Insert"},
                                                                            {Key::enter, "Enter"},
                                                                            {Key::backspace, "Backspace"},
                                                                            {Key::space, "Space"},
                                                                            {Key::up, "Up"},
                                                                            {Key::down, "Down"},
                                                                            {Key::left, "Left"},
                                                                            {Key::right, "Right"},
                                                                            {Key::tab, "Tab"},
                                                                            {Key::f1, "F1"},
                                                                            {Key::f2, "F2"},
                                                                            {Key::f3, "F3"},
                                                                            {Key::f4, "F4"},
                                                                            {Key::f5, "F5"},
                                                                            {Key::f6, "F6"},
                                                                            {Key::f7, "F7"},
                                                                            {Key::f8, "F8"},
                                                                            {Key::f9, "F9"},
                                                                            {Key::f10, "F10"},
                                                                            {Key::f11, "F11"},
                                                                            {Key::f12, "F12"},
                                                                            {Key::pad0, "Num 0"},
                                                                            {Key::pad1, "Num 1"},
                                                                            {Key::pad2, "Num 2"},
                                                                            {Key::pad3, "Num 3"},
                                                                            {Key::pad4, "Num 4"},
                                                                            {Key::pad5, "Num 5"},
                                                                            {Key::pad6, "Num 6"},
                                                                            {Key::pad7, "Num 7"},
                                                                            {Key::pad8, "Num 8"},
                                                                            {Key::pad9, "Num 9"},
                                                                            {Key::pad_point, "Num ."},
                                                                            {Key::pad_plus, "Num +"},
                                                                            {Key::pad_minus, "Num -"},
                                                                            {Key::pad_enter, "Num Enter"}});

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
  const auto found = std::ranges::find(key_names, key, &std::pair<Key, std::string_view>::first);
  if (found != key_names.end()) return std::string(found->second);
  return std::string(1, static_cast<char>(key));
}

std::optional<Key> key_of(std::string_view name) {
  for (const auto& [key, word] : key_names) {
    if (same_word(name, word)) return key;
  }
  if (name.size() != 1 || !is_printed(upper(name[0]))) return std::nullopt;
  return key(upper(name[0]));
}

}  // namespace

std::span<const Key> all_keys() {
  static const std::vector<Key> all = [] {
    std::vector<Key> keys;
    for (const auto& [key, name] : key_names) keys.push_back(key);
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
  // The key itself may be a plus: no part before it is empty.
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
