// Descriptions of mouse actions for the help and the status bar.
#pragma once

#include <string>
#include <vector>

#include "workspace/keymap.h"

namespace viete::ui {

struct MouseLine {
  std::string action, what;
};

std::vector<MouseLine> mouse_lines(const workspace::Keymap& keymap);

/// Describes camera navigation. Two spaces separate the phrases.
std::string looking_words(const workspace::Keymap& keymap);
/// Describes the effect of a drag on empty space, and camera navigation.
std::string empty_space_words(const workspace::Keymap& keymap);

/// The command's first key, or its label in quotes if it has no key.
std::string key_or_label(const workspace::Keymap& keymap, std::string_view command);

}  // namespace viete::ui
