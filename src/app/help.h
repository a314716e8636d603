// Help texts for the terminal, the manual's pages, and suggestions for misspelled words.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace viete::app {

/// Wraps a text at spaces to lines of at most `width`, with `indent` spaces before each line but the first,
/// which starts at `column`. A longer word is alone on its line. Keeps line breaks in the text.
std::string wrapped(std::string_view text, std::size_t column, std::size_t indent, std::size_t width = 80);

/// The edit distance of two words: insertions, deletions, replacements and swaps of neighbouring letters.
std::size_t misspellings(std::string_view a, std::string_view b);

/// The name probably meant: one with the word as prefix, or with a small edit distance. Empty if there is
/// none.
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

/// "viete bench exp": the command parsed so far.
std::string name_of_command(const CLI::App& app);

/// The error of a command line, in one or two lines that end with the help to read. Unknown words are
/// reported before missing ones.
std::string usage_error(const CLI::App& app, const CLI::Error& error);

/// The names of an app's subcommands.
std::vector<std::string> command_names(const CLI::App& app);

}  // namespace viete::app
