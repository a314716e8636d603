// Help that fits a terminal, the manual's pages, and suggestions for misspelt words.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <memory>
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

/// One entry of a list in the help, 80 columns wide, with its line break.
std::string help_line(const std::string& name, const std::string& text);
/// Ends the help of a command by examples.
void add_examples(CLI::App& command, const std::vector<std::string>& lines);

/// Writes --help, 80 columns wide. A command's usage line is made of its options, unless `usage` is given for
/// the program itself.
std::shared_ptr<CLI::FormatterBase> help_formatter();

/// "viete bench exp": the command that the command line has got to.
std::string name_of_command(const CLI::App& app);

/// What is wrong with a command line, in one or two lines that end with the help to read. What the program
/// does not know is named before what it misses.
std::string usage_error(const CLI::App& app, const CLI::Error& error);

/// The names of an app's commands.
std::vector<std::string> command_names(const CLI::App& app);

}  // namespace viete::app
