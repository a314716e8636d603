// viete deform MODEL CAGE --pose POSE -o OUT, or viete deform SESSION -o OUT: the deformed mesh as a file.
#include <filesystem>
#include <memory>

#include "app/command_line.h"
#include "app/inputs.h"
#include "app/options.h"
#include "app/output.h"
#include "scene/files/export.h"

namespace viete::app {

namespace {

struct DeformOptions {
  Inputs inputs{Use::file};
  std::filesystem::path output;
  mesh::Digits digits;
  bool force = false;
};

int deform_file(const DeformOptions& options) {
  const scene::Opened opened =
      open(options.inputs, scene::check_deformable, {options.output, Content::surface, options.force});
  print_notes(opened.warnings);
  scene::Export what = scene::export_of(*opened.document, options.output);
  what.digits = options.digits;
  if (opened.session && opened.session->camera) what.up = opened.session->camera->up;
  print_notes(scene::write_deformed(what));
  return exit_ok;
}

}  // namespace

void add_deform_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("deform", "Deform a mesh by a posed cage and write it");
  auto o = std::make_shared<DeformOptions>();
  add_input_options(*command, o->inputs);
  add_file_option(*command, "-o,--output", o->output, "File to write; the extension chooses the format")
      ->required();
  add_digits_option(*command, o->digits);
  add_force_option(*command, o->force);
  command->callback([o, &action] {
    check_usage(o->inputs);
    action = [o] { return deform_file(*o); };
  });
}

}  // namespace viete::app
