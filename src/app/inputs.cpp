#include "app/inputs.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "foreign/read.h"

namespace viete::app {

namespace fs = std::filesystem;

namespace {

void add_files(CLI::App& app, Inputs& inputs) {
  auto* model = add_file_option(app, "MODEL", inputs.model, foreign::a_mesh() + " or session (.viete)");
  inputs.use == Use::window ? model->default_str("the bundled dragon") : model->required();
  add_file_option(app, "CAGE", inputs.cage, "Cage at rest");
  add_file_option(app, "--model", inputs.located.model, "Model that replaces the model of the session");
  add_file_option(app, "--cage", inputs.located.cage, "Cage that replaces the cage of the session");
  if (inputs.use == Use::animation) return;
  add_file_option(app, "--pose", inputs.pose, "Posed cage, with the vertices and faces of the cage");
}

void add_deformer_options(CLI::App& app, document::RequestedSettings& settings) {
  auto* preset =
      add_choice<pose::Preset>(app, "--deformer", "Deformer, see 'viete help deformers'", settings.preset);
  preset->default_str("smooth");
  add_choice_options(app, settings.choice);
  for (const char* other : {"--weights", "--blend"}) preset->excludes(app.get_option(other));
  for (const char* name : {"radius", "rotation", "stretch"}) add_number_option(app, name, settings);
  add_arap_options(app, settings);
}

void check(const Output& output, const FilesInUse& files, const files::FrameSteps* frames) {
  if (!frames) return check_output(output.file, output.content, files, output.force);
  check_output(output.file, *frames, files, force_of(output.force));
}

}  // namespace

void add_input_options(CLI::App& app, Inputs& inputs) {
  add_files(app, inputs);
  add_method_option(app, [&inputs](sym3::Method method) { inputs.settings.method = method; });
  add_deformer_options(app, inputs.settings);
}

CLI::Option* add_output_options(CLI::App& app, Output& output, const std::string& text) {
  auto* file = add_file_option(app, "-o,--output", output.file, text)->required();
  if (output.content != Content::picture) add_digits_option(app, output.digits);
  add_force_option(app, output.force);
  return file;
}

void add_split_option(CLI::App& app, Output& output) {
  app.add_flag("--split", output.split,
               "Captures: split splats whose longest axis grows by more than 2.5 times");
}

void check_usage(const Inputs& inputs) {
  if (inputs.session()) {
    if (inputs.cage.empty() && inputs.pose.empty()) return;
    throw CLI::ValidationError(
        inputs.cage.empty() ? "--pose" : "CAGE",
        "the session " + inputs.model.string() + " has its own " +
            (inputs.cage.empty() ? "pose: omit --pose" : "cage: omit CAGE, or use --cage to replace it"));
  }
  if (!inputs.located.model.empty() || !inputs.located.cage.empty())
    throw CLI::ValidationError(inputs.located.model.empty() ? "--cage" : "--model",
                               "requires a session (.viete)");
  const bool file = inputs.use == Use::file;
  const bool needs_cage = file || inputs.use == Use::animation;
  if (needs_cage && inputs.cage.empty()) throw CLI::RequiredError("CAGE");
  if (file && inputs.pose.empty()) throw CLI::RequiredError("--pose");
  document::Document tried;
  put_settings(tried, inputs.settings);
}

files::Opened open(const Inputs& inputs, void (*check)(const files::Opened&)) {
  files::Opened opened;
  try {
    opened = files::open_files(inputs.request(), {});
  } catch (const files::SessionFileError& error) {
    throw base::Error(error.place(), error.problem(),
                      "name the file with --" + std::string(error.key) + " FILE");
  }
  if (const auto& cage = opened.document->cage())
    for (const std::string& warning : cage->warnings)
      opened.warnings.push_back(place_of(opened.document->cage_file()) + ": " + warning);
  check(opened);
  const bool deforms = inputs.use == Use::file || inputs.use == Use::animation;
  if (deforms && !opened.document->is_movable()) {
    print_notes(opened.warnings);
    throw base::Error(inputs.model.string(), "the session has no cage",
                      "open it in the window and add a cage");
  }
  return opened;
}

files::Opened open(const Inputs& inputs, void (*check)(const files::Opened&), const Output& output,
                   const document::FileInUse& also) {
  const auto check_files = [&](FilesInUse files) {
    files.add(also.path, also.what);
    check_output(output.file, output.content, files, output.force);
  };
  check_files(files_read(inputs));
  files::Opened opened = open(inputs, check);
  check_files(files::files_of(opened));
  return opened;
}

FilesInUse files_read(const Inputs& inputs) {
  FilesInUse files;
  files.add(inputs.model, inputs.session() ? document::the_session : document::the_model);
  files.add(inputs.cage, document::the_cage);
  files.add(inputs.pose, document::the_pose);
  files.add(inputs.located.model, document::the_model);
  files.add(inputs.located.cage, document::the_cage);
  return files;
}

void print_notes(const std::vector<std::string>& notes) {
  for (const auto& note : notes) std::fprintf(stderr, "viete: note: %s\n", base::printable(note).c_str());
}

void print_summary(const Output& output, const std::string& summary) {
  std::printf("%s: %s\n", base::printable(output.file.string()).c_str(), base::printable(summary).c_str());
}

OpenedShapes open_shapes(const std::filesystem::path& model, std::span<const std::filesystem::path> shapes,
                         const Output& output, const files::FrameSteps* frames) {
  FilesInUse named;
  named.add(model, document::the_model);
  for (const auto& file : shapes) named.add(file, document::a_shape);
  check(output, named, frames);
  if (files::is_session(model))
    throw base::Error(model.string(), "this is a session, but shapes need a mesh file",
                      "use the mesh file of the model");
  OpenedShapes all;
  {
    TerminalProgress work("Reading " + model.filename().string());
    all.model = files::open_files({files::OpenRequest::What::model, {model}}, {}, &work.progress());
    files::check_drawable(all.model);
    files::check_deformable(all.model);
    const mesh::Surface& surface = *all.model.document->model().surface;
    files::check_shape_rest(model.string(), surface);
    files::check_shape_count(model.string(), shapes.size(), surface);
    for (const auto& file : shapes) {
      files::ImportedShapes read = files::read_shapes({&file, 1}, surface, &work.progress());
      all.of_files.push_back(std::move(read.shapes));
      for (auto& path : read.files) all.model.also_read.push_back({std::move(path), document::a_shape});
      for (auto& warning : read.warnings) all.model.warnings.push_back(std::move(warning));
    }
  }
  check(output, files::files_of(all.model), frames);
  print_notes(all.model.warnings);
  return all;
}

files::Export export_to(const Output& output, const files::Opened& opened) {
  files::Export what = files::export_of(*opened.document, output.file);
  what.digits = output.digits;
  what.split = output.split;
  if (opened.session && opened.session->camera) what.up = opened.session->camera->up;
  return what;
}

int write_frames(const Output& output, const files::AnimationExport& what) {
  const files::AnimationReport report = [&] {
    TerminalProgress work(output.task());
    return files::write_animation(what, &work.progress());
  }();
  print_notes(report.notes);
  print_summary(output, report.summary);
  return exit_ok;
}

std::vector<std::string> write_shape(const files::Export& what, const std::string& name,
                                     base::Progress* progress) {
  if (!document::in_range({{}, {}, what.shape}))
    throw base::Error(what.file.string(), name + " is too large to draw",
                      "use smaller weights and positions closer to the model");
  return files::write_exact(what, {what.shape ? *what.shape : what.model->positions, {}, {}, 0, what.splats},
                            progress);
}

int run_cancellable(const Output& output, const std::function<int()>& write, const char* advice) {
  try {
    return write();
  } catch (const base::Cancelled&) {
    throw base::Error(output.file.string(), "stopped", advice);
  }
}

}  // namespace viete::app
