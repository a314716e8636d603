// Words on a terminal: lines that fit, and what a misspelt word was meant to be.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace viete::app {

/// Breaks a text at blanks, so that no line is longer than `width`, and starts every line but the first with
/// `indent` blanks; the first one begins after `column` characters of its own. A longer word stands alone on
/// its line. Line breaks in the text stay.
std::string wrapped(std::string_view text, std::size_t column, std::size_t indent, std::size_t width = 80);

/// How many letters are to be put in, taken out, replaced or exchanged with their neighbour to make one word
/// of the other.
std::size_t misspellings(std::string_view a, std::string_view b);

/// The name that was probably meant: one that begins like the word, or that takes few corrections. Empty if
/// there is none.
std::string nearest(std::string_view word, const std::vector<std::string>& names);

/// "a", "a or b", "a, b or c".
std::string listed(const std::vector<std::string>& names);

}  // namespace viete::app
