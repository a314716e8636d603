// Shared option types of subcommands: numbers, words, files, sizes; help texts, and suggestions for
// misspelled words.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "deform/scheme.h"
#include "document/document.h"
#include "files/output.h"
#include "formats/text_writer.h"
#include "sym3/exp.h"

namespace viete::app {

/// An input or output file.
CLI::Option* add_file_option(CLI::App& app, const std::string& name, std::filesystem::path& file,
                             const std::string& text);
/// Accepts a finite number from low to high; the range is shown in help and errors.
CLI::Option* in_range(CLI::Option* option, double low, double high);
/// As above, for integers.
CLI::Option* whole_in_range(CLI::Option* option, std::int64_t low, std::int64_t high);
/// Accepts one of these words.
CLI::Option* one_of(CLI::Option* option, const std::vector<std::string>& words);
/// Takes a name of the table.
template <class Entry, class Target>
CLI::Option* add_choice(CLI::App& app, const std::string& name, const std::string& text,
                        std::span<const Entry> table, Target& target) {
  std::vector<std::string> words;
  for (const Entry& e : table) words.emplace_back(e.name);
  const auto take = [&target, table](const std::string& word) {
    target = std::ranges::find(table, word, &Entry::name)->value;
  };
  return one_of(app.add_option_function<std::string>(name, take, text), words);
}

/// --force, for commands that write files, see check_output().
void add_force_option(CLI::App& app, bool& force);
/// The value of --force; errors suggest the option, except in a child process of the window.
files::Force force_of(bool given);

/// --method WORD.
void add_method_option(CLI::App& app, const std::function<void(sym3::Method)>& take);
/// A number of the deformer: --radius PERCENT.
void add_number_option(CLI::App& app, std::string_view name, deform::AskedScheme& asked);
/// --stitched with --iterations NUMBER, --pins and --hold PERCENT.
void add_stitching_options(CLI::App& app, deform::AskedScheme& asked);

/// --weights and --blend, with the names in the tables.
void add_choice_options(CLI::App& app, deform::PartialChoice& choice);

/// The choices of these options, of --method, --map and of probes, with a sentence each.
std::string deformers_help();

/// --digits NUMBER|all, for coordinates in text files.
void add_digits_option(CLI::App& app, formats::Digits& digits);
/// The limit of a picture's pixels; its sides are limited to 131072.
inline constexpr std::int64_t most_pixels = std::int64_t{1} << 28;
/// --size WxH in logical pixels, 16 to 32768 each.
void add_size_option(CLI::App& app, glm::ivec2& size);

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
