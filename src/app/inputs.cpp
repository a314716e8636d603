#include "app/inputs.h"

#include <cstdio>
#include <span>

#include "app/options.h"
#include "app/words.h"
#include "base/error.h"
#include "base/text.h"
#include "mesh/formats/format_table.h"
#include "scene/files/animation_export.h"

namespace viete::app {

namespace fs = std::filesystem;

namespace {

void add_files(CLI::App& app, Inputs& inputs) {
  auto* model =
      add_file_option(app, "MODEL", inputs.model,
                      mesh::a_mesh() + ", or a session (.viete), which names its own cage and pose");
  inputs.use == Use::window ? model->default_str("the bundled dragon") : model->required();
  add_file_option(app, "CAGE", inputs.cage, "Cage around it, at rest");
  add_file_option(app, "--model", inputs.located.model,
                  "Use this model instead of the one that the session names");
  add_file_option(app, "--cage", inputs.located.cage,
                  "Use this cage instead of the one that the session names");
  if (inputs.use == Use::animation) return;
  add_file_option(app, "--pose", inputs.pose, "Posed version of the cage, same vertices in the same order");
}

void add_amount_option(CLI::App& app, const std::string& name, const std::string& what,
                       std::optional<double>& amount) {
  add_percent_option(app, name, amount, deform::amount_from_percent, 200,
                     "How much of the cage's " + what + " acts, in percent, 0 to 200: 0 leaves it out")
      ->default_str("100");
}

void add_scheme_options(CLI::App& app, Inputs& inputs) {
  deform::PartialChoice& choice = inputs.settings.choice;
  auto* way = add_way_option(app, inputs.settings.way);
  add_choice_options(app, choice);
  for (const char* other : {"--weights", "--blend"}) way->excludes(app.get_option(other));
  add_radius_option(app, inputs.settings.radius);
  add_amount_option(app, "--turn", "rotation", inputs.settings.turn);
  add_amount_option(app, "--stretch", "stretch", inputs.settings.stretch);
  add_stitching_options(app, inputs.settings);
}

}  // namespace

void add_input_options(CLI::App& app, Inputs& inputs) {
  add_files(app, inputs);
  add_method_option(app, [&inputs](sym3::Method method) { inputs.settings.method = method; });
  add_scheme_options(app, inputs);
}

void check_usage(const Inputs& inputs) {
  if (inputs.session()) {
    if (inputs.cage.empty() && inputs.pose.empty()) return;
    throw CLI::ValidationError(inputs.cage.empty() ? "--pose" : "CAGE",
                               "the session " + inputs.model.string() + " names its own: leave it out" +
                                   (inputs.cage.empty() ? "" : ", or replace it by --cage"));
  }
  if (!inputs.located.model.empty() || !inputs.located.cage.empty())
    throw CLI::ValidationError(inputs.located.model.empty() ? "--cage" : "--model",
                               "can only be used with a session (.viete)");
  const bool file = inputs.use == Use::file;
  const bool needs_cage = file || inputs.use == Use::animation;
  if (needs_cage && inputs.cage.empty()) throw CLI::RequiredError("CAGE");
  if (file && inputs.pose.empty()) throw CLI::RequiredError("--pose");
  scene::Document tried;
  put_settings(tried, inputs.settings);
}

scene::Opened open(const Inputs& inputs, void (*check)(const scene::Opened&)) {
  scene::Opened opened;
  try {
    opened = scene::open_files(inputs.request(), {});
  } catch (const scene::SessionFileError& error) {
    throw base::Error(error.place(), error.problem(), "name it with --" + std::string(error.key) + " FILE");
  }
  check(opened);
  const scene::Document& document = *opened.document;
  const bool deforms = inputs.use == Use::file || inputs.use == Use::animation;
  const bool movable = deforms ? document.is_movable() : document.has_cage();
  if (deforms && !movable) {
    print_notes(opened.warnings);
    throw base::Error(inputs.model.string(), "the session has no cage", "open it and add one");
  }
  return opened;
}

scene::Opened open(const Inputs& inputs, void (*check)(const scene::Opened&), const Output& output,
                   const scene::FileInUse& also) {
  const auto check_files = [&](FilesInUse files) {
    files.add(also.path, also.what);
    check_output(output.file, output.content, files, output.force);
  };
  check_files(files_read(inputs));
  scene::Opened opened = open(inputs, check);
  check_files(scene::files_of(opened));
  return opened;
}

FilesInUse files_read(const Inputs& inputs) {
  FilesInUse files;
  files.add(inputs.model, inputs.session() ? scene::the_session : scene::the_model);
  files.add(inputs.cage, scene::the_cage);
  files.add(inputs.pose, scene::the_pose);
  files.add(inputs.located.model, scene::the_model);
  files.add(inputs.located.cage, scene::the_cage);
  return files;
}

void print_notes(const std::vector<std::string>& notes) {
  for (const auto& note : notes) std::fprintf(stderr, "viete: note: %s\n", base::printable(note).c_str());
}

void print_summary(const fs::path& file, const std::string& summary) {
  std::printf("%s: %s\n", base::printable(file.string()).c_str(), base::printable(summary).c_str());
}

}  // namespace viete::app
