// Fonts of the system that have the characters which the program's own fonts lack.
#pragma once

#include <filesystem>
#include <set>
#include <vector>

namespace viete::ui {

/// A font file and the characters to take from it.
struct SystemFont {
  std::filesystem::path file;
  unsigned face = 0;  ///< index in a font collection
  std::set<char32_t> characters;
};

/// Returns few fonts that together have as many of the characters as possible, preferring fonts for the
/// user's language. Characters without a font are omitted. Empty if
/// fontconfig is missing.
std::vector<SystemFont> fonts_with(std::set<char32_t> characters);

}  // namespace viete::ui
