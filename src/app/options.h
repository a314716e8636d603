// Kinds of options that subcommands share: numbers, words, files, sizes.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/formats/text_writer.h"
#include "scene/document/settings.h"
#include "scene/files/output.h"
#include "sym3/exp.h"

namespace viete::app {

/// A file to be read or written.
CLI::Option* add_file_option(CLI::App& app, const std::string& name, std::filesystem::path& file,
                             const std::string& text);
/// Takes a number from low to high, neither NaN nor infinity: says so in help and errors.
CLI::Option* in_range(CLI::Option* option, double low, double high);
/// The same of whole numbers.
CLI::Option* whole_in_range(CLI::Option* option, std::int64_t low, std::int64_t high);
/// Takes one of these words.
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

/// Takes what `read` makes of a number from 0 to `most`.
CLI::Option* add_percent_option(CLI::App& app, const std::string& name, std::optional<double>& value,
                                std::optional<double> (*read)(double), int most, const std::string& text);
/// --force, of a command that writes files, see check_output().
void add_force_option(CLI::App& app, bool& force);
/// The option, which errors offer; not in a program that the window runs aside.
scene::Force force_of(bool given);

/// --method WORD.
void add_method_option(CLI::App& app, const std::function<void(sym3::Method)>& take);
/// --stitched, and --iterations NUMBER, --pins and --hold PERCENT of it.
void add_stitching_options(CLI::App& app, scene::AskedSettings& asked);

CLI::Option* add_way_option(CLI::App& app, std::optional<deform::Way>& way);

/// --weights and --blend, by the names of the tables.
void add_choice_options(CLI::App& app, deform::PartialChoice& choice);

/// The choices of these options, of --method, --map and of probes, with a sentence each.
std::string deformers_help();

/// --radius PERCENT.
void add_radius_option(CLI::App& app, std::optional<double>& asked);

/// --digits NUMBER|all, of coordinates in text files.
void add_digits_option(CLI::App& app, mesh::Digits& digits);
/// A picture has no more; its sides are no longer than 131072.
inline constexpr std::int64_t most_pixels = std::int64_t{1} << 28;
/// --size WxH in logical pixels, 16 to 32768 each.
void add_size_option(CLI::App& app, glm::ivec2& size);

}  // namespace viete::app
