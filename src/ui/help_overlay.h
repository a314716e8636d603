// Descriptions of the mouse buttons for help and status bar.
#pragma once

#include <string>
#include <vector>

#include "workspace/keymap.h"

namespace viete::ui {

struct MouseLine {
  std::string action, what;
};

/// The complete list for the help.
std::vector<MouseLine> mouse_lines(const workspace::Keymap& keymap);

/// Camera navigation, in phrases separated by two spaces.
std::string looking_words(const workspace::Keymap& keymap);
/// Dragging on empty space, and camera navigation.
std::string empty_space_words(const workspace::Keymap& keymap);

/// "F1", or if it has no key its label in quotes.
std::string key_or_label(const workspace::Keymap& keymap, std::string_view command);

}  // namespace viete::ui
