// viete deform MODEL CAGE --pose POSE -o OUT, or viete deform SESSION -o OUT: exports the deformed mesh.
// viete deform MODEL CAGE --stream: deforms continuously for another program.
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "app/inputs.h"
#include "app/view_model.h"
#include "base/error.h"
#include "base/file_bytes.h"
#include "base/text.h"

namespace viete::app {

namespace {

struct DeformOptions {
  Inputs inputs{Use::file};
  Output output;
  std::filesystem::path mask;
  bool stream = false;
};

// Reads one number per vertex, separated by whitespace.
weights::Mask mask_of(const std::filesystem::path& file, std::size_t vertices) {
  const base::FileBytes bytes(file);
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
                      "it has " + base::counted(shares.size(), "number") + " for " +
                          base::with_thousands(vertices) + " vertices",
                      "give one number for each vertex of the model");
  return std::make_shared<const std::vector<float>>(std::move(shares));
}

void take_mask(const DeformOptions& options, files::Export& what) {
  if (!options.mask.empty()) what.mask = mask_of(options.mask, what.model->positions.size());
}

constexpr double largest_number = 1e60;  // the same limit as for poses in files

// Reads the next pose. Returns nullopt at the end of the input.
std::optional<std::vector<mesh::Point>> next_pose(std::size_t vertices, std::size_t number) {
  std::vector<mesh::Point> positions(vertices);
  static_assert(sizeof(mesh::Point) == 3 * sizeof(double));
  const std::size_t bytes = vertices * sizeof(mesh::Point),
                    got = std::fread(positions.data(), 1, bytes, stdin);
  if (std::ferror(stdin))
    throw base::Error("standard input", std::string("cannot be read: ") + std::strerror(errno),
                      "send poses through a pipe or from a file");
  if (got == 0) return std::nullopt;
  const auto refuse = [&](const std::string& problem, const std::string& advice) {
    throw base::Error("pose " + std::to_string(number), problem, advice);
  };
  if (got < bytes)
    refuse("it ends after " + std::to_string(got) + " of " + std::to_string(bytes) + " bytes",
           "send three float64 for each vertex of the cage");
  for (std::size_t v = 0; v < vertices; ++v)
    for (const double x : positions[v])
      if (!(std::abs(x) <= largest_number))
        refuse("vertex " + std::to_string(v) + " is not finite or too large", "send numbers up to 1e60");
  return positions;
}

// Prints a note if rounding to float changes coordinates much, and by more than the last note has stated.
void note_rounding(std::span<const float> floats, double diagonal, double& noted) {
  double farthest = 0;
  for (const float x : floats) farthest = std::max<double>(farthest, std::abs(x));
  const double rounding = 0x1p-24 * farthest;
  if (rounding <= noted) return;
  noted = 2 * rounding;
  print_notes(formats::rounding_notes(noted, diagonal));
}

void write_positions(const deform::FrameDeformer& deformer, std::size_t number, std::vector<float>& floats) {
  const auto vertices = deformer.vertices();
  const mesh::Vec3 origin = deformer.origin();
  floats.clear();
  for (const auto& vertex : vertices)
    for (std::size_t k = 0; k < 3; ++k) {
      floats.push_back(static_cast<float>(origin[k] + vertex.position[k]));
      if (!std::isfinite(floats.back()))
        throw base::Error("pose " + std::to_string(number), "a deformed position is too large for float32",
                          "scale the cage and the model");
    }
  if (std::fwrite(floats.data(), sizeof(float), floats.size(), stdout) != floats.size() ||
      std::fflush(stdout) != 0)
    throw base::Error("standard output", "it cannot be written", "check the disk space");
}

// Reads poses until the input ends. Immediately writes the deformed positions of each pose. Cage vertices are
// three float64, model vertices three float32, in native byte order. Rotations of the cage's parts continue
// from the previous pose. Throws base::Error for an invalid or incomplete pose, and if writing fails.
void stream_poses(const files::Export& what) {
  base::Progress progress;
  const Bound bound =
      app::bind({what.model, what.cage, what.splats}, what.deformer, what.method, {}, progress);
  base::WorkerPool pool;
  deform::FrameDeformer deformer(bound.cage, bound.binding, what.deformer, pool, bound.stitching);
  deformer.set_mask(what.mask);
  deformer.set_shape(what.shape);
  deformer.set_probes(what.probes);
  const std::size_t vertices = what.cage->surface.positions.size();
  std::vector<float> floats;
  std::vector<mesh::Vec3> turns;
  const double diagonal = mesh::bounds(what.model->positions).diagonal();
  double noted = 0;
  for (std::size_t number = 1;; ++number) {
    auto positions = next_pose(vertices, number);
    if (!positions) return;
    deformer.deform({std::move(*positions), turns}, what.method);
    turns = deformer.state().report().turns;
    write_positions(deformer, number, floats);
    note_rounding(floats, diagonal, noted);
  }
}

int stream(const DeformOptions& options) {
  if (base::os::is_terminal(stdout))
    throw base::Error("--stream", "positions would be written to the terminal",
                      "redirect the output to a program or a file");
  for (std::FILE* file : {stdin, stdout}) base::os::make_binary(file);
  const files::Opened opened = open(options.inputs, files::check_deformable);
  print_notes(opened.warnings);
  if (!opened.document->has_cage())
    throw base::Error(options.inputs.model.string(), "the session has no cage",
                      "open it in the window and add a cage");
  files::Export what = files::export_of(*opened.document, {});
  take_mask(options, what);
  stream_poses(what);
  return exit_ok;
}

int write_file(const DeformOptions& options) {
  const files::Opened opened =
      open(options.inputs, files::check_deformable, options.output, {options.mask, document::the_mask});
  print_notes(opened.warnings);
  files::Export what = export_to(options.output, opened);
  take_mask(options, what);
  std::optional<TerminalProgress> work(options.output.task());
  const std::vector<std::string> notes = files::write_deformed(what, &work->progress());
  work.reset();  // removes the progress line
  print_notes(notes);
  return exit_ok;
}

}  // namespace

void add_deform_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("deform", "Deform a mesh by a posed cage and write the result");
  auto o = std::make_shared<DeformOptions>();
  add_input_options(*command, o->inputs);
  auto* output = add_output_options(*command, o->output)->required(false);
  add_split_option(*command, o->output);
  add_file_option(*command, "--mask", o->mask,
                  "File with one number per vertex, from 0 (stays at rest) to 1");
  auto* stream_option = command->add_flag("--stream", o->stream,
                                          "Read poses from standard input (3 float64 per cage vertex) and "
                                          "write positions to standard output (3 float32 per model vertex)");
  stream_option->excludes(output);
  if (auto* pose = command->get_option_no_throw("--pose")) stream_option->excludes(pose);
  add_examples(*command, {"deform model.obj cage.obj --pose pose.obj -o deformed.obj",
                          "deform scene.viete --deformer arap -o deformed.ply"});
  command->callback([o, &action] {
    if (o->stream) o->inputs.use = Use::animation;  // does not need --pose
    if (!o->stream && o->output.file.empty()) throw CLI::RequiredError("--output");
    check_usage(o->inputs);
    action = [o] {
      return o->stream ? stream(*o) : run_cancellable(o->output, [&] { return write_file(*o); });
    };
  });
}

}  // namespace viete::app
