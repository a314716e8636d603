#include "workspace/shortcut.h"

#include <algorithm>
#include <initializer_list>
#include <vector>

#include "base/file_bytes.h"

namespace viete::workspace {

namespace {

bool same_word(std::string_view a, std::string_view b) {
  return base::lower_case(a) == base::lower_case(b);
}

}  // namespace

std::span<const std::pair<Key, std::string>> all_keys() {
  static const auto all = [] {
    std::vector<std::pair<Key, std::string>> keys;
    const auto add = [&](Key first, std::initializer_list<const char*> names) {
      int code = static_cast<int>(first);
      for (const char* name : names) keys.emplace_back(static_cast<Key>(code++), name);
    };
    add(Key::escape, {"Esc", "Enter", "Tab", "Backspace", "Insert", "Delete", "Right", "Left", "Down", "Up",
                      "Page Up", "Page Down", "Home", "End"});
    add(Key::f1, {"F1", "F2", "F3", "F4", "F5", "F6", "F7", "F8", "F9", "F10", "F11", "F12"});
    add(Key::pad0,
        {"Num 0", "Num 1", "Num 2", "Num 3", "Num 4", "Num 5", "Num 6", "Num 7", "Num 8", "Num 9", "Num ."});
    add(Key::pad_minus, {"Num -", "Num +", "Num Enter"});
    add(Key::space, {"Space"});
    for (const char c : std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.,-=/"))
      keys.emplace_back(key(c), std::string(1, c));
    return keys;
  }();
  return all;
}

std::string text(const Shortcut& shortcut) {
  if (shortcut.key == Key::none) return "";
  return std::string(shortcut.ctrl ? "Ctrl+" : "") + (shortcut.shift ? "Shift+" : "") +
         (shortcut.alt ? "Alt+" : "") +
         std::ranges::find(all_keys(), shortcut.key, &std::pair<Key, std::string>::first)->second;
}

std::optional<Shortcut> shortcut_of(std::string_view text) {
  Shortcut shortcut;
  if (text.empty()) return shortcut;
  // A plus sign can also belong to the name of the key, as in "Num +". There the loop ends.
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
  const auto found =
      std::ranges::find_if(all_keys(), [&](const auto& k) { return same_word(text, k.second); });
  if (found == all_keys().end()) return std::nullopt;
  shortcut.key = found->first;
  return shortcut;
}

}  // namespace viete::workspace
