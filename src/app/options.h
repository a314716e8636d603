// Options that several subcommands share: methods, coordinates, sizes.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>

#include "scene/document.h"
#include "sym3/exp.h"

namespace viete::app {

/// --method diag|sd|improved_sd|fast. The target must outlive parsing.
void add_method_option(CLI::App& app, sym3::Method& method);
/// --coordinates face|mvc and --reach NUMBER|all. What is not given a session keeps as it has it.
struct WeightingOptions {
  deform::Coordinates coordinates = deform::Coordinates::face;
  double reach = deform::whole_cage;
  bool coordinates_given = false, reach_given = false;

  /// To a document that was just opened. Throws base::Error if a reach is given where coordinates have none.
  void apply(scene::Document& document, bool of_session) const;
};
void add_weighting_options(CLI::App& app, WeightingOptions& options);
/// --reach alone, of faces.
CLI::Option* add_reach_option(CLI::App& app, double& reach);
/// --binding FILE, written by `viete bind`.
void add_binding_option(CLI::App& app, std::filesystem::path& file);
/// A session names its cage and its pose itself: throws CLI::ValidationError if MODEL is one and others are
/// given too.
void check_session_stands_alone(const std::filesystem::path& model, const std::filesystem::path& cage,
                                const std::filesystem::path& pose);
/// --size WxH in logical pixels, 16 to 8192 each.
void add_size_option(CLI::App& app, glm::ivec2& size);

/// An option that names a file to be written once the work is done. The place is tried at parsing, so that
/// minutes of work are not lost to a misspelt folder: throws CLI::ValidationError.
void add_result_option(CLI::App& app, const std::string& name, std::filesystem::path& target,
                       const std::string& text);

}  // namespace viete::app
