// viete deform MODEL CAGE --pose POSE -o OUT, or viete deform SESSION -o OUT: exports the deformed mesh;
// viete deform MODEL CAGE --stream: deforms continuously for another program.
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/help.h"
#include "app/inputs.h"
#include "app/options.h"
#include "app/pose_stream.h"
#include "base/error.h"
#include "base/text.h"
#include "mesh/formats/source.h"
#include "scene/files/export.h"

namespace viete::app {

namespace {

struct DeformOptions {
  Inputs inputs{Use::file};
  std::filesystem::path output, mask;
  mesh::Digits digits;
  bool force = false, stream = false;
};

// Reads whitespace-separated numbers in vertex order.
deform::Mask mask_of(const std::filesystem::path& file, std::size_t vertices) {
  const mesh::FileBytes bytes(file, nullptr);
  std::istringstream in{std::string(bytes.view())};
  std::vector<float> shares;
  std::string word;
  while (in >> word) {
    char* end = nullptr;
    shares.push_back(std::strtof(word.c_str(), &end));
    if (*end != '\0' || !(shares.back() >= 0 && shares.back() <= 1))
      throw base::Error(file.string(), "number " + std::to_string(shares.size()) + " is not between 0 and 1",
                        "use numbers from 0 to 1");
  }
  if (shares.size() != vertices)
    throw base::Error(file.string(),
                      "it has " + base::counted(shares.size(), "share") + " for " +
                          base::with_thousands(vertices) + " vertices",
                      "give one number for each vertex of the model");
  return std::make_shared<const std::vector<float>>(std::move(shares));
}

void take_mask(const DeformOptions& options, scene::Export& what) {
  if (!options.mask.empty()) what.mask = mask_of(options.mask, what.model->positions.size());
}

int stream(const DeformOptions& options) {
  if (isatty(STDOUT_FILENO))
    throw base::Error("--stream", "positions would be written to the terminal",
                      "redirect the output to a program or a file");
  const scene::Opened opened = open(options.inputs, scene::check_deformable);
  print_notes(opened.warnings);
  if (!opened.document->has_cage())
    throw base::Error(options.inputs.model.string(), "the session has no cage",
                      "open it in the window and add a cage");
  scene::Export what = scene::export_of(*opened.document, {});
  take_mask(options, what);
  stream_poses(what, stdin, stdout);
  return exit_ok;
}

int deform_file(const DeformOptions& options) {
  const scene::Opened opened =
      open(options.inputs, scene::check_deformable, {options.output, Content::surface, options.force},
           {options.mask, scene::the_mask});
  print_notes(opened.warnings);
  scene::Export what = scene::export_of(*opened.document, options.output);
  what.digits = options.digits;
  take_mask(options, what);
  if (opened.session && opened.session->camera) what.up = opened.session->camera->up;
  print_notes(scene::write_deformed(what));
  return exit_ok;
}

}  // namespace

void add_deform_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("deform", "Deform a mesh by a posed cage and write the result");
  auto o = std::make_shared<DeformOptions>();
  add_input_options(*command, o->inputs);
  auto* output = add_file_option(*command, "-o,--output", o->output,
                                 "Mesh file to write; the extension sets the format");
  add_file_option(*command, "--mask", o->mask, "File with one weight from 0 (rest) to 1 per vertex");
  auto* stream_option = command->add_flag("--stream", o->stream,
                                          "Read poses from standard input (3 float64 per cage vertex) and "
                                          "write positions to standard output (3 float32 per model vertex)");
  stream_option->excludes(output);
  if (auto* pose = command->get_option_no_throw("--pose")) stream_option->excludes(pose);
  add_digits_option(*command, o->digits);
  add_force_option(*command, o->force);
  add_examples(*command, {"deform model.obj cage.obj --pose pose.obj -o deformed.obj",
                          "deform scene.viete --deformer arap -o deformed.ply"});
  command->callback([o, &action] {
    if (o->stream) o->inputs.use = Use::animation;  // poses come from the stream
    if (!o->stream && o->output.empty()) throw CLI::RequiredError("--output");
    check_usage(o->inputs);
    action = [o] { return o->stream ? stream(*o) : deform_file(*o); };
  });
}

}  // namespace viete::app
