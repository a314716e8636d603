// viete between A B -o PATTERN: interpolates between shapes of a model.
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "app/inputs.h"
#include "base/error.h"
#include "base/numbered_files.h"
#include "base/os.h"
#include "base/text.h"
#include "document/animation.h"
#include "formats/point_cache.h"
#include "formats/source.h"

namespace viete::app {

namespace {

constexpr int most_frames = 100'000;

struct BetweenOptions {
  std::vector<std::filesystem::path> files;
  std::filesystem::path rest;  // empty: the first file is the rest shape
  Output output;
  std::optional<double> at;
  int frames = 25;
  double rate = 24;
  bool linear = false, constant_speed = false, loop = false;
};

// If the first argument is a pattern such as pose_##.obj, replaces the pattern by the matching files.
void expand_pattern(std::vector<std::filesystem::path>& files) {
  if (!base::NumberedName::is_pattern(files.front())) return;
  const base::NumberedName name(files.front());
  std::vector<std::filesystem::path> all;
  for (const auto& file : name.find()) all.push_back(file.path);
  if (all.empty())
    throw base::Error(name.pattern(), "no file matches this name with digits in place of #",
                      "check the name and use one # for each digit");
  all.insert(all.end(), files.begin() + 1, files.end());
  files = std::move(all);
}

// The shapes to interpolate, in order.
struct ShapeList {
  OpenedShapes opened;
  std::vector<document::SharedShape> shapes;
};

ShapeList open_list(const BetweenOptions& options, const files::FrameSteps* frames = nullptr) {
  const bool first_is_rest = options.rest.empty();
  if (first_is_rest && formats::point_cache_format(options.files.front()))
    throw base::Error(options.files.front().string(), "a point cache has no faces",
                      "name the mesh file of the rest shape with --rest");
  const auto& model = first_is_rest ? options.files.front() : options.rest;
  const auto shapes = std::span(options.files).subspan(first_is_rest ? 1 : 0);
  ShapeList list{open_shapes(model, shapes, options.output, frames), {}};
  if (first_is_rest) list.shapes.push_back(nullptr);
  for (const auto& of_file : list.opened.of_files)
    for (const document::NamedShape& shape : of_file) list.shapes.push_back(shape.shape);
  if (list.shapes.size() < 2)
    throw base::Error(options.files.front().string(), "a single shape cannot be interpolated",
                      "give another shape");
  if (options.loop) list.shapes.push_back(list.shapes.front());
  return list;
}

// A timeline with the shapes as evenly spaced keys.
document::Timeline timeline_of(const BetweenOptions& options, const ShapeList& list, int first, int last) {
  const std::size_t steps = list.shapes.size() - 1;
  document::Timeline timeline;
  timeline.first = first;
  timeline.last = last;
  timeline.linear = options.linear;
  timeline.repeat = options.loop ? document::Repeat::loop : document::Repeat::once;
  const auto easing =
      options.constant_speed || steps == 1 ? document::Easing::constant_speed : document::Easing::smooth;
  for (std::size_t i = 0; i <= steps; ++i) {
    document::WholePose pose;
    pose.shape = list.shapes[i];
    const double share = static_cast<double>(i) / static_cast<double>(steps);
    timeline.keys.push_back({first + static_cast<int>(std::lround((last - first) * share)),
                             std::make_shared<const document::WholePose>(std::move(pose)), easing});
  }
  return timeline;
}

int write_moment(const BetweenOptions& options) {
  const ShapeList list = open_list(options);
  const auto last = static_cast<int>(list.shapes.size()) - 1;
  if (*options.at > last)
    throw base::Error("",
                      "--at " + base::few_digits(*options.at) + " is beyond the last shape, which is at " +
                          std::to_string(last),
                      "0 is the first shape, 1 the second, 1.5 halfway from the second to the third");
  const document::Document& document = *list.opened.model.document;
  files::Export what = export_to(options.output, list.opened.model);
  std::optional<TerminalProgress> work(options.output.task());
  document::VectorCache vectors;
  vectors.follow_model(document.model().surface);
  const document::Animation animation(timeline_of(options, list, 0, last), vectors);
  what.shape = animation.at(*options.at).shape;
  const auto notes = write_shape(what, "the shape", &work->progress());
  work.reset();  // removes the progress line
  print_notes(animation.notes());
  print_notes(notes);
  return exit_ok;
}

int write_motion(const BetweenOptions& options) {
  const files::FrameSteps steps{1, options.frames, 1};
  const ShapeList list = open_list(options, &steps);
  const std::string shapes = std::to_string(list.shapes.size());
  if (static_cast<std::size_t>(options.frames) < list.shapes.size())
    throw base::Error(options.output.file.string(),
                      std::to_string(options.frames) + " frames are too few for " + shapes + " shapes",
                      "set --frames to " + shapes + " or more");
  files::AnimationExport what = files::animation_export_of(*list.opened.model.document, options.output.file);
  what.timeline = timeline_of(options, list, 1, options.frames);
  what.last = options.frames;
  what.rate = options.rate;
  what.model.digits = options.output.digits;
  what.force = force_of(options.output.force);
  return write_frames(options.output, what);
}

int between(BetweenOptions options) {
  base::os::keep_freed_memory();
  expand_pattern(options.files);
  if (options.at) return run_cancellable(options.output, [&] { return write_moment(options); });
  return run_cancellable(
      options.output, [&] { return write_motion(options); }, "files written so far are complete");
}

}  // namespace

void add_between_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("between", "Interpolate between shapes of a model");
  auto o = std::make_shared<BetweenOptions>();
  command
      ->add_option("SHAPES", o->files,
                   "Model and other shapes with the same faces: meshes, numbered meshes (pose_##.obj), point "
                   "caches or glTF morph targets")
      ->required();
  add_output_options(
      *command, o->output,
      "File to write: numbered meshes (out_###.obj), .pc2, .mdd, .glb or .gltf; with --at a mesh file");
  auto* frames = command->add_option("--frames", o->frames, "Number of frames");
  whole_in_range(frames, 2, most_frames)->default_str("25");
  auto* at = command->add_option_function<double>(
      "--at", [o](double at) { o->at = at; },
      "Write only the shape at this place (0: first shape, 1: second, 1.5: halfway to the third)");
  in_range(at, 0, most_frames)->excludes(frames);
  add_file_option(*command, "--rest", o->rest, "File of the rest shape")->default_str("the first shape");
  command->add_flag("--loop", o->loop, "Also interpolate from the last shape to the first");
  command->add_flag("--constant-speed", o->constant_speed,
                    "Interpolate at constant speed instead of smoothly");
  command->add_flag("--linear", o->linear, "Interpolate vertex positions linearly");
  auto* rate = command->add_option("--rate", o->rate, "Frames per second of .mdd and glTF");
  in_range(rate, document::Timeline::least_rate, document::Timeline::largest_rate)->default_str("24");
  add_examples(*command, {"between rest.obj smile.obj --frames 25 -o motion.pc2",
                          "between rest.obj smile.obj --at 0.5 -o half.obj"});
  command->callback([o, &action] { action = [o] { return between(*o); }; });
}

}  // namespace viete::app
