// viete between A B -o PATTERN: interpolates between shapes of a model.
// viete mix REST --shape FILE=0.5 ... -o OUT: combines weighted shapes of a model.
// viete pose REST --pin VERTEX=x,y,z ... -o OUT: poses a model by pinned vertices and example shapes.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "app/inputs.h"
#include "base/error.h"
#include "base/numbered_files.h"
#include "base/os.h"
#include "base/text.h"
#include "document/animation.h"
#include "document/document_state.h"
#include "foreign/read.h"
#include "formats/point_cache.h"
#include "formats/source.h"
#include "shapes/example_posing.h"

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

namespace {

using document::PoseLibrary;

struct Share {
  std::filesystem::path file;
  double weight;
  std::string name = {};
};

struct MixOptions {
  std::filesystem::path rest;
  Output output;
  std::vector<Share> shares;
  bool linear = false;
};

// Parses text such as "smile.obj=0.5".
Share share_of(const std::string& text) {
  const auto equals = text.rfind('=');
  double weight = 0;
  const char* const end = text.data() + text.size();
  const bool read = equals != text.npos && equals > 0 &&
                    std::from_chars(text.data() + equals + 1, end, weight).ptr == end &&
                    equals + 1 < text.size();
  if (!read || !(weight >= PoseLibrary::least_weight && weight <= PoseLibrary::largest_weight))
    throw CLI::ValidationError("--shape", "needs FILE=WEIGHT, such as smile.obj=0.5, with a weight from " +
                                              std::to_string(int(PoseLibrary::least_weight)) + " to " +
                                              std::to_string(int(PoseLibrary::largest_weight)) + ", not " +
                                              text);
  return {text.substr(0, equals), weight};
}

// If the file does not exist, splits a name such as "face.glb:smile" into the file and the name of a shape.
void split_name(Share& share) {
  const std::string text = share.file.string();
  std::error_code ignored;
  if (std::filesystem::exists(share.file, ignored)) return;
  for (auto colon = text.find(':'); colon != text.npos; colon = text.find(':', colon + 1)) {
    share = {text.substr(0, colon), share.weight, text.substr(colon + 1)};
    if (std::filesystem::exists(share.file, ignored)) return;
  }
}

document::SharedShape shape_of(const Share& share, const std::vector<document::NamedShape>& shapes) {
  if (share.name.empty() && shapes.size() == 1) return shapes.front().shape;
  constexpr std::size_t most = 12;
  std::vector<std::string> names;
  for (const document::NamedShape& shape : shapes) {
    if (shape.name == share.name) return shape.shape;
    names.push_back(shape.name);
  }
  throw base::Error(
      share.file.string(),
      share.name.empty() ? "it contains several shapes" : "it contains no shape named " + share.name,
      "append one of these names after a colon: " + base::joined(names, ", ", most));
}

int write_mix(MixOptions options) {
  std::vector<std::filesystem::path> files;
  for (Share& share : options.shares) {
    split_name(share);
    files.push_back(share.file);
  }
  const OpenedShapes opened = open_shapes(options.rest, files, options.output);
  std::vector<document::ShapeTerm> terms;
  for (std::size_t i = 0; i < files.size(); ++i)
    terms.push_back({shape_of(options.shares[i], opened.of_files[i]), options.shares[i].weight});
  files::Export what = export_to(options.output, opened.model);
  std::vector<std::string> notes;
  std::optional<TerminalProgress> work(options.output.task());
  base::WorkerPool pool;
  const shapes::ShapeSpace space(*what.model, pool, &work->progress());
  what.shape = document::mixed(space, terms, options.linear, pool, &notes);
  for (auto& note : write_shape(what, "the mix", &work->progress())) notes.push_back(std::move(note));
  work.reset();  // removes the progress line
  print_notes(notes);
  return exit_ok;
}

}  // namespace

void add_mix_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("mix", "Combine weighted shapes of a model");
  auto o = std::make_shared<MixOptions>();
  command->add_option("REST", o->rest, foreign::a_mesh())->required();
  command
      ->add_option_function<std::vector<std::string>>(
          "--shape",
          [o](const std::vector<std::string>& texts) {
            for (const auto& text : texts) o->shares.push_back(share_of(text));
          },
          "Shape with the same faces, and its weight: smile.obj=0.5, or face.glb:smile=0.5 if the file "
          "contains several shapes; repeatable")
      ->allow_extra_args(false)
      ->option_text("FILE=WEIGHT ...")
      ->required();
  command->add_flag("--linear", o->linear, "Combine vertex positions linearly");
  add_output_options(*command, o->output);
  add_examples(*command, {"mix rest.obj --shape smile.obj=0.5 -o mixed.obj",
                          "mix rest.obj --shape face.glb:smile=1 --shape sad.obj=-0.2 -o mix.ply"});
  command->callback(
      [o, &action] { action = [o] { return run_cancellable(o->output, [&] { return write_mix(*o); }); }; });
}

namespace {

constexpr int most_steps = 200;

struct Pin {
  std::uint32_t vertex;
  mesh::Point target;
  bool holds;
};

struct PoseOptions {
  std::filesystem::path rest;
  Output output;
  std::vector<std::filesystem::path> examples;
  std::vector<Pin> pins;
  shapes::PosingSettings settings;
};

// Parses text such as "1234=0.1,2,-3".
Pin pin_of(const std::string& text, const std::string& option, bool holds) {
  unsigned vertex = 0;
  mesh::Point p;
  int end = 0;
  const int read = std::sscanf(text.c_str(), "%9u=%lf,%lf,%lf%n", &vertex, &p[0], &p[1], &p[2], &end);
  const auto fits = [](double x) { return std::abs(x) <= mesh::largest_coordinate; };  // false for NaN
  if (read != 4 || static_cast<std::size_t>(end) != text.size() || text[0] == '-' ||
      !std::ranges::all_of(p, fits))
    throw CLI::ValidationError(option,
                               "needs VERTEX=x,y,z, such as 1234=0.1,2,-3 (vertices from 0), not " + text);
  return {vertex, p, holds};
}

void add_pins_option(CLI::App& command, const std::string& name, bool holds, const std::string& text,
                     const std::shared_ptr<PoseOptions>& o) {
  command
      .add_option_function<std::vector<std::string>>(
          name,
          [o, name, holds](const std::vector<std::string>& texts) {
            for (const auto& t : texts) o->pins.push_back(pin_of(t, name, holds));
          },
          text + "; repeatable")
      ->allow_extra_args(false)
      ->option_text("VERTEX=x,y,z ...");
}

void check_pins(const PoseOptions& options, const mesh::Surface& model) {
  std::vector<std::uint32_t> vertices;
  for (const Pin& pin : options.pins) {
    if (pin.vertex >= model.positions.size())
      throw base::Error(options.rest.string(),
                        "vertex " + std::to_string(pin.vertex) +
                            " does not exist: vertices are numbered 0 to " +
                            std::to_string(model.positions.size() - 1),
                        "choose a vertex in this range");
    vertices.push_back(pin.vertex);
  }
  std::ranges::sort(vertices);
  const auto twice = std::ranges::adjacent_find(vertices);
  if (twice != vertices.end())
    throw base::Error(options.rest.string(), "vertex " + std::to_string(*twice) + " is pinned twice",
                      "pin it to a single position");
}

struct Posed {
  std::vector<mesh::Point> positions;
  std::vector<double> weights;
  int steps;
  double farthest;  // largest distance between a pinned vertex and its target, in diagonals of the model
};

Posed posed(const PoseOptions& options, const mesh::Surface& model,
            std::span<const document::NamedShape> examples, base::Progress& progress) {
  base::WorkerPool pool;
  progress.section(0, 0.3);
  const shapes::ShapeSpace space(model, pool, &progress);
  progress.section(0.3, 1);
  std::vector<shapes::LogVector> vectors;
  std::vector<const shapes::LogVector*> pointers;
  vectors.reserve(examples.size());
  for (const auto& example : examples) {
    pointers.push_back(&vectors.emplace_back(space.vector(*example.shape, pool)));
    progress.report(0.5 * static_cast<double>(vectors.size()) / static_cast<double>(examples.size()));
  }
  shapes::ExamplePosing posing(space, std::move(pointers), pool);
  std::vector<shapes::PosingPin> pins;
  std::vector<mesh::Point> targets;
  for (const Pin& pin : options.pins) {
    pins.push_back({pin.vertex, pin.holds ? std::numeric_limits<double>::infinity() : 1.0});
    targets.push_back(pin.target);
  }
  posing.set_pins(std::move(pins));
  const int steps = posing.solve(targets, options.settings, most_steps, &progress);
  Posed result{{posing.positions().begin(), posing.positions().end()}, posing.weights(), steps, 0};
  const double diagonal = mesh::used_bounds(model).diagonal();
  for (std::size_t k = 0; k < targets.size(); ++k)
    result.farthest = std::max(result.farthest,
                               mesh::norm(result.positions[options.pins[k].vertex] - targets[k]) / diagonal);
  return result;
}

int write_pose(const PoseOptions& options) {
  const OpenedShapes opened = open_shapes(options.rest, options.examples, options.output);
  files::Export what = export_to(options.output, opened.model);
  check_pins(options, *what.model);
  std::vector<document::NamedShape> examples;
  for (const auto& of_file : opened.of_files) examples.insert(examples.end(), of_file.begin(), of_file.end());
  std::optional<TerminalProgress> work(options.output.task());
  const Posed result = posed(options, *what.model, examples, work->progress());
  what.shape = std::make_shared<const std::vector<mesh::Point>>(result.positions);
  std::vector<std::string> notes = write_shape(what, "the pose", &work->progress());
  work.reset();  // removes the progress line
  if (result.steps == most_steps)
    notes.push_back("the pose is not exact: the solution has not converged after " +
                    std::to_string(most_steps) + " steps");
  print_notes(notes);
  print_summary(options.output, base::counted(std::size_t(result.steps), "step") +
                                    ", largest distance of a pin to its target " +
                                    base::few_digits(100 * result.farthest) + " % of the diagonal");
  for (std::size_t e = 0; e < examples.size(); ++e)
    std::printf("%8.3f  %s\n", result.weights[e], base::printable(examples[e].name).c_str());
  return exit_ok;
}

}  // namespace

void add_pose_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("pose", "Pose a model by pinned vertices and example shapes");
  auto o = std::make_shared<PoseOptions>();
  command->add_option("REST", o->rest, foreign::a_mesh())->required();
  command
      ->add_option("--examples", o->examples,
                   "Example shapes: meshes, numbered meshes (pose_##.obj), point cache or glTF morph "
                   "targets; repeatable (default: none, the model stays as rigid as possible)")
      ->allow_extra_args(false)
      ->option_text("FILE ...");
  add_pins_option(*command, "--pin", true, "Vertex number (from 0) and its exact position", o);
  add_pins_option(*command, "--pull", false, "Vertex number and a position that attracts it", o);
  auto* freedom = command->add_option("--freedom", o->settings.freedom,
                                      "How much the pose may differ from blends of examples");
  in_range(freedom, 0, 1)->default_str("0.3; 1 without examples");
  auto* restraint =
      command->add_option("--restraint", o->settings.restraint, "How strongly example weights stay near 0");
  in_range(restraint, 0, 1e3)->default_str("0.001");
  add_output_options(*command, o->output);
  add_examples(*command, {"pose rest.obj --pin 0=0,0,0 --pin 1234=0.1,2,-3 -o posed.obj",
                          "pose rest.obj --examples pose_##.obj --pin 1234=0.1,2,-3 -o posed.obj"});
  command->callback([o, freedom, &action] {
    if (o->pins.empty()) throw CLI::RequiredError("--pin");
    if (o->examples.empty() && freedom->count() == 0) o->settings.freedom = 1;
    action = [o] { return run_cancellable(o->output, [&] { return write_pose(*o); }); };
  });
}

}  // namespace viete::app
