#include "app/options.h"

#include <cstdio>
#include <map>

#include "base/atomic_file.h"
#include "base/error.h"
#include "scene/edit.h"
#include "scene/session.h"

namespace viete::app {

void add_method_option(CLI::App& app, sym3::Method& method) {
  app.add_option_function<std::string>(
         "--method", [&method](const std::string& word) { method = *sym3::method_from_name(word); },
         "How exp is computed: diag, sd, improved_sd or fast")
      ->check(CLI::IsMember({"diag", "sd", "improved_sd", "fast"}))
      ->default_str("fast");
}

void add_weighting_options(CLI::App& app, WeightingOptions& options) {
  app.add_option_function<std::string>(
         "--coordinates",
         [&options](const std::string& word) {
           options.coordinates = *deform::coordinates_from_name(word);
           options.coordinates_given = true;
         },
         "How the cage moves the mesh: face (affine maps blended in log space) or mvc (mean value "
         "coordinates)")
      ->check(CLI::IsMember({"face", "mvc"}))
      ->default_str("face");
  add_reach_option(app, options.reach)->each([&options](const std::string&) { options.reach_given = true; });
}

CLI::Option* add_reach_option(CLI::App& app, double& reach) {
  const std::string lowest = deform::text_of_reach(deform::lowest_reach);
  return app
      .add_option_function<std::string>(
          "--reach",
          [&reach, lowest](const std::string& text) {
            const auto number = deform::reach_from_text(text);
            if (!number)
              throw CLI::ValidationError("--reach", "needs a number from " + lowest + " on, or all");
            reach = *number;
          },
          "Of coordinates face: how many times as far as the nearest faces a face still moves the mesh, " +
              lowest + " or more, or all: every face moves all of it")
      ->default_str("all");
}

void WeightingOptions::apply(scene::Document& document, bool of_session) const {
  if (!of_session || coordinates_given) scene::set_coordinates(document, coordinates);
  if (!of_session || reach_given) scene::set_reach(document, reach);
  if (reach_given && document.coordinates == deform::Coordinates::mean_value) {
    throw base::Error("--reach",
                      "mean value coordinates have no reach: every vertex of the cage moves all of the model",
                      "leave it out, or add --coordinates face");
  }
}

void add_binding_option(CLI::App& app, std::filesystem::path& file) {
  app.add_option("--binding", file,
                 "What viete bind has saved of this model and cage, instead of binding them");
}

void check_session_stands_alone(const std::filesystem::path& model, const std::filesystem::path& cage,
                                const std::filesystem::path& pose) {
  if (!scene::is_session(model) || (cage.empty() && pose.empty())) return;
  throw CLI::ValidationError(cage.empty() ? "--pose" : "CAGE",
                             "the session " + model.string() + " names its own: leave it out");
}

void add_size_option(CLI::App& app, glm::ivec2& size) {
  app.add_option_function<std::string>(
         "--size",
         [&size](const std::string& text) {
           int w = 0, h = 0;
           char rest = 0;
           const bool whole = std::sscanf(text.c_str(), "%dx%d%c", &w, &h, &rest) == 2;
           if (!whole || w < 16 || h < 16 || w > 8192 || h > 8192) {
             throw CLI::ValidationError("--size",
                                        "needs WIDTHxHEIGHT, each 16 to 8192, for example 1280x800");
           }
           size = {w, h};
         },
         "Size of the picture in logical pixels, WIDTHxHEIGHT")
      ->default_str("1280x800");
}

void add_result_option(CLI::App& app, const std::string& name, std::filesystem::path& target,
                       const std::string& text) {
  app.add_option(name, target, text)->check([](const std::string& path) -> std::string {
    try {
      base::check_replaceable(path);
      return {};
    } catch (const base::Error& error) {
      return error.what();
    }
  });
}

}  // namespace viete::app
