// Options that several commands use, help texts, and suggestions for misspelled words.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "document/document.h"
#include "files/output.h"
#include "formats/text_writer.h"
#include "pose/deformer.h"
#include "sym3/exp.h"

namespace viete::app {

CLI::Option* add_file_option(CLI::App& app, const std::string& name, std::filesystem::path& file,
                             const std::string& text);
/// Accepts only numbers from `low` to `high`. Help and errors show the range.
CLI::Option* in_range(CLI::Option* option, double low, double high);
/// Accepts only integers from `low` to `high`. Help and errors show the range.
CLI::Option* whole_in_range(CLI::Option* option, std::int64_t low, std::int64_t high);
/// Accepts only these words.
CLI::Option* one_of(CLI::Option* option, const std::vector<std::string>& words);
/// Adds an option that accepts only the words of an enumeration, see base/choice.h. Sets `target`, a Value or
/// an optional Value.
template <class Value, class Target>
CLI::Option* add_choice(CLI::App& app, const std::string& name, const std::string& text, Target& target) {
  std::vector<std::string> words;
  for (const base::Choice& choice : choices(Value{})) words.emplace_back(choice.word);
  const auto take = [&target](const std::string& word) { target = *base::value_of_word<Value>(word); };
  return one_of(app.add_option_function<std::string>(name, take, text), words);
}

/// Adds --force, see check_output().
void add_force_option(CLI::App& app, bool& force);
/// Converts the value of --force. Without --force, errors suggest this option, except in a child process.
files::Force force_of(bool given);

void add_method_option(CLI::App& app, const std::function<void(sym3::Method)>& take);
/// Adds the option of a deformer setting, for example --radius PERCENT.
void add_number_option(CLI::App& app, std::string_view name, pose::AskedDeformer& asked);
/// Adds --arap, --iterations NUMBER, --attach PERCENT and --hold PERCENT.
void add_arap_options(CLI::App& app, pose::AskedDeformer& asked);

/// Adds --weights WORD and --blend WORD.
void add_choice_options(CLI::App& app, pose::PartialChoice& choice);

/// The help on deformers, weights, blends, falloffs of probes, methods and maps: one sentence for each name.
std::string deformers_help();

/// Adds --digits NUMBER|all, for coordinates in text files.
void add_digits_option(CLI::App& app, formats::Digits& digits);
/// The largest number of pixels of a picture.
inline constexpr std::int64_t most_pixels = std::int64_t{1} << 28;
/// Adds --size WxH, in logical pixels, 16 to 32768 each.
void add_size_option(CLI::App& app, glm::ivec2& size);

/// Wraps a text at spaces, so that lines have at most `width` characters. The first line starts at `column`;
/// all other lines begin with `indent` spaces. Longer words get their own line. Keeps line breaks.
std::string wrapped(std::string_view text, std::size_t column, std::size_t indent, std::size_t width = 80);

/// The edit distance of two words: the number of insertions, deletions, replacements and swaps of
/// neighbouring letters.
std::size_t misspellings(std::string_view a, std::string_view b);

/// Returns the name most similar to a misspelled word, or an empty text. A name is similar if it begins with
/// the word, if the word begins with the name, or if the edit distance is small.
std::string nearest(std::string_view word, const std::vector<std::string>& names);

/// Adds examples at the end of a command's help.
void add_examples(CLI::App& command, const std::vector<std::string>& lines);

/// Formats the help of the program and its commands, wrapped to 80 columns.
std::shared_ptr<CLI::FormatterBase> help_formatter();

/// The error message for a wrong command line, with a second line that refers to the help. An unknown word is
/// reported before a missing word.
std::string usage_error(const CLI::App& app, const CLI::Error& error);

std::vector<std::string> command_names(const CLI::App& app);

}  // namespace viete::app
