// viete bind MODEL CAGE -o OUT, or viete bind SESSION -o OUT: the binding as a file, for --binding.
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/command_line.h"
#include "app/inputs.h"
#include "app/options.h"
#include "app/output.h"
#include "base/clock.h"
#include "base/quantity.h"
#include "base/worker_pool.h"
#include "deform/binding.h"
#include "deform/binding_file.h"

namespace viete::app {

namespace {

struct BindOptions {
  Inputs inputs{Use::binding};
  std::filesystem::path output;
  double tolerance = deform::usual_tolerance;
  bool force = false;
};

void print(const deform::TiledBinding& tiles, double seconds) {
  const std::string handles(deform::name(tiles.weighting.elements));
  std::printf("bound %s vertices to %zu cage %s in %.2f s: %.1f MB",
              base::with_thousands(tiles.leaves.vertices).c_str(), tiles.handles, handles.c_str(), seconds,
              static_cast<double>(tiles.bytes()) * 1e-6);
  const double dense = static_cast<double>(tiles.dense_bytes()) * 1e-6;
  if (tiles.compressed()) std::printf(", compressed to %g from %.1f MB", tiles.tolerance, dense);
  if (tiles.has_lists())
    std::printf(", in lists of %.0f %s on average, instead of %.1f MB", tiles.mean_rows(), handles.c_str(),
                dense);
  std::printf("\n");
}

int bind_files(const BindOptions& options) {
  const scene::Opened opened = open(options.inputs, scene::check_drawable,  // what is bound is for pictures
                                    {options.output, Content::binding, options.force});
  print_notes(opened.warnings);
  const scene::Document& document = *opened.document;
  base::WorkerPool pool;
  base::Stopwatch watch;
  const auto tiles = deform::bind_tiles(*document.model.surface, *document.cage, document.scheme.weighting,
                                        pool, options.tolerance);
  print(tiles, 1e-3 * watch.lap_ms());
  print_notes(deform::weight_warnings(*document.cage, tiles.weighting.weights, tiles.failed,
                                      document.model.surface->positions.size()));
  deform::write_binding(options.output, tiles, *document.model.surface, *document.cage);
  return exit_ok;
}

}  // namespace

void add_bind_command(CLI::App& app, Action& action) {
  auto* command =
      app.add_subcommand("bind", "Bind a model to its cage and save that, for view and render --binding");
  auto o = std::make_shared<BindOptions>();
  add_input_options(*command, o->inputs);
  add_file_option(*command, "-o,--output", o->output, "File to write")->required();
  add_force_option(*command, o->force);
  auto* tolerance = command->add_option(
      "--tolerance", o->tolerance,
      "What compression may change the weights of a vertex by (root of the sum of squares; 0: no "
      "compression)");
  in_range(tolerance, 0, 0.1)->default_str("3e-5");
  command->footer(
      "The file is checked against model and cage whenever it is used. view and render also keep bindings "
      "that took "
      "more than a second by themselves, in ~/.cache/viete/bindings ($XDG_CACHE_HOME), 2 GB at most.");
  command->callback([o, &action] {
    check_usage(o->inputs);
    action = [o] { return bind_files(*o); };
  });
}

}  // namespace viete::app
