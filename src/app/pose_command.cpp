// viete pose REST --pin VERTEX=x,y,z ... -o OUT: poses a model by pinned vertices and example shapes.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "app/inputs.h"
#include "base/error.h"
#include "base/text.h"
#include "foreign/read.h"
#include "shapes/example_posing.h"

namespace viete::app {

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
