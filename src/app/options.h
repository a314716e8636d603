// Options that several subcommands share: methods, coordinates, sizes.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>

#include "deform/binding.h"
#include "sym3/exp.h"

namespace viete::app {

/// --method diag|sd|improved_sd|fast. The target must outlive parsing.
void add_method_option(CLI::App& app, sym3::Method& method);
/// --coordinates face|mvc.
void add_coordinates_option(CLI::App& app, deform::Coordinates& coordinates);
/// --binding FILE, written by `viete bind`.
void add_binding_option(CLI::App& app, std::filesystem::path& file);
/// A session names its cage and its pose itself: throws CLI::ValidationError if MODEL is one and others are given too.
void check_session_stands_alone(const std::filesystem::path& model, const std::filesystem::path& cage,
                                const std::filesystem::path& pose);
/// --size WxH in logical pixels, 16 to 8192 each.
void add_size_option(CLI::App& app, glm::ivec2& size);

/// An option that names a file to be written once the work is done. The place is tried at parsing, so that minutes of
/// work are not lost to a misspelt folder: throws CLI::ValidationError.
void add_result_option(CLI::App& app, const std::string& name, std::filesystem::path& target, const std::string& text);

}  // namespace viete::app
