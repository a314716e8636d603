// The mouse buttons in words, for help and status bar.
#pragma once

#include <string>
#include <vector>

#include "scene/workspace/keymap.h"

namespace viete::ui {

struct MouseLine {
  std::string action, what;
};

/// All of it, for the help.
std::vector<MouseLine> mouse_lines(const scene::Keymap& keymap);

/// How one looks around, in phrases with two spaces between them.
std::string looking_words(const scene::Keymap& keymap);
/// What a drag on nothing does, and how one looks around.
std::string empty_space_words(const scene::Keymap& keymap);

/// "F1", or where it has no key its label in quotes.
std::string key_or_label(const scene::Keymap& keymap, std::string_view command);

}  // namespace viete::ui
