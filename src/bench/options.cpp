#include "bench/options.h"

#include <cstdio>
#include <memory>

#include "app/assets.h"
#include "app/help.h"
#include "app/options.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/text.h"
#include "bench/accuracy.h"
#include "bench/bind.h"
#include "bench/eigen.h"
#include "bench/exp.h"
#include "bench/frame.h"
#include "bench/modes.h"
#include "bench/sym3.h"
#include "bench/table.h"
#include "mesh/formats/format_table.h"
#include "sym3/kernel.h"

namespace viete::bench {

using app::Content, app::FilesInUse;

void BenchFiles::check(const FilesInUse& inputs) const {
  app::check_output(json, Content::json, inputs, force);
  FilesInUse all = inputs;
  all.add(json, "the numbers");
  app::check_output(plot, Content::svg, all, force);
}

void add_rounds_option(CLI::App& app, std::size_t& rounds, const char* usual) {
  app::whole_in_range(app.add_option("--rounds", rounds, "Number of repetitions"), 1, 1000)
      ->default_str(usual);
}

void add_bench_files(CLI::App& app, BenchFiles& files, bool has_plot) {
  app::add_file_option(app, "--json", files.json, "JSON file for the numbers");
  if (has_plot) app::add_file_option(app, "--plot", files.plot, "SVG file for a plot");
  app::add_force_option(app, files.force);
}

// viete bench exp|eigen|accuracy|sym3|frame|bind|modes.

namespace {

using namespace app;

struct BenchOptions {
  std::size_t count = 0;
  bool in_float = false;
  BenchFiles files;
};

constexpr std::size_t paper_count = 10'000'000;
constexpr std::int64_t most_matrices = 1'000'000'000;

// Fails before the system kills the program. A matrix needs input and output, at most nine doubles each.
void require_memory_for(std::size_t count) {
  base::require_memory({160.0 * static_cast<double>(count), base::with_thousands(count) + " matrices take",
                        "give a smaller number", "--count"});
}

template <class Bench>
int report(const Bench& bench, const BenchOptions& options) {
  print(bench);
  write_json(options.files.json, to_json(bench));
  if (!options.files.plot.empty()) base::replace_file(options.files.plot, draw_plot(plot_of(bench)));
  return exit_ok;
}

int run_exp(const BenchOptions& options) {
  base::Progress progress;
  return report(measure_exp(options.count, options.in_float, progress), options);
}

int run_eigen(const BenchOptions& options) {
  base::Progress progress;
  return report(measure_eigen(options.count, progress), options);
}

int run_sym3(const BenchOptions& options) {
  bench_sym3(options.count, options.files.json);
  return exit_ok;
}

int run_accuracy(const BenchOptions& options) {
  base::Progress progress;
  const auto tables = measure_accuracy(options.count, options.in_float, progress);
  std::printf("Largest relative error (Frobenius norm) in u = 2^%d against 106 bits, kernel %s\n\n",
              options.in_float ? -24 : -53, std::string(sym3::kernel_name()).c_str());
  for (const auto& table : tables) print(table, options.in_float);
  write_json(options.files.json, {{"figure", "accuracy"}, {"tables", to_json(tables)}});
  return exit_ok;
}

// A benchmark of a model: its options and outputs.
template <class Options>
struct ModelBench {
  Options options{};
  BenchFiles files{};
};

// The last options, and the run: `prepare` checks the files and takes the bundled model if none is given;
// `check` completes the options, or rejects them.
template <class Options, class Prepare>
void finish(
    CLI::App& command, Action& action, const std::shared_ptr<ModelBench<Options>>& bench,
    void (*run)(const Options&), Prepare prepare, const std::function<void()>& check = [] {}) {
  add_bench_files(command, bench->files);
  command.callback([=, &action] {
    check();
    action = [=] {
      prepare(bench->options, bench->files);
      bench->options.json = bench->files.json;
      run(bench->options);
      return exit_ok;
    };
  });
}

CLI::Option* add_model(CLI::App& command, std::filesystem::path& model) {
  return add_file_option(command, "MODEL", model, mesh::a_mesh())->default_str("the bundled dragon");
}

template <class Options>
CLI::Option* add_model_and_cage(CLI::App& command, Options& options, const char* usual_cage) {
  add_model(command, options.model);
  return add_file_option(command, "CAGE", options.cage, "Cage at rest")->default_str(usual_cage);
}

template <class Options>
void prepare_model(Options& options, const BenchFiles& files) {
  files.check({options.model, options.cage});
  if (options.model.empty()) options.model = bundled_model().model;
}

void add_frame_bench(CLI::App& command, Action& action) {
  auto bench = std::make_shared<ModelBench<FrameOptions>>();
  auto& options = bench->options;
  auto* cage = add_model_and_cage(command, options, "generated cages, see --faces");
  auto* counts =
      command.add_option("--vertices", options.counts,
                         "Numbers of vertices, comma-separated; 200000 and 800000 subdivide the model");
  whole_in_range(counts, 1, most_vertices)->delimiter(',')->allow_extra_args(false)->default_str("all");
  auto* faces = command.add_option("--faces", options.faces, "Numbers of cage triangles, comma-separated");
  whole_in_range(faces, 8, 10'000)
      ->delimiter(',')
      ->allow_extra_args(false)
      ->default_str("50,100,300,600")
      ->excludes(cage);
  add_rounds_option(command, options.rounds, "11");
  auto* tolerance =
      command.add_option("--tolerance", options.tolerance, "Tolerance of the compressed weights");
  in_range(tolerance, 0, 0.1)->default_str("3e-5");
  finish(command, action, bench, bench_frame, prepare_model<FrameOptions>);
}

void add_bind_bench(CLI::App& command, Action& action) {
  auto bench = std::make_shared<ModelBench<BindOptions>>();
  auto& options = bench->options;
  auto* cage = add_model_and_cage(command, options, "a generated cage, see --faces");
  auto* count = command.add_option("--vertices", options.count, "Minimum number of vertices, by subdivision");
  whole_in_range(count, 1, most_vertices)->default_str("all");
  auto* faces = command.add_option("--faces", options.faces, "Number of cage triangles");
  whole_in_range(faces, 8, 10'000)->default_str("300")->excludes(cage);
  add_rounds_option(command, options.rounds, "5");
  finish(command, action, bench, bench_bind, prepare_model<BindOptions>);
}

void prepare_modes(ModesOptions& options, const BenchFiles& files) {
  FilesInUse inputs{options.model, options.cage};
  for (const auto& pose : options.poses) inputs.add(pose, scene::the_pose);
  files.check(inputs);
  if (!options.model.empty()) return;
  const BundledModel bundled = bundled_model();
  options.model = bundled.model, options.cage = bundled.cage, options.poses = bundled.poses;
}

void require_pose(const std::filesystem::path& model, const std::filesystem::path& cage, bool is_posed) {
  if (!model.empty() && !is_posed) throw CLI::RequiredError(cage.empty() ? "CAGE" : "POSE");
}

void add_modes_bench(CLI::App& command, Action& action) {
  auto bench = std::make_shared<ModelBench<ModesOptions>>();
  auto& options = bench->options;
  auto& settings = options.settings;
  add_model_and_cage(command, options, "the dragon's cage");
  command.add_option("POSE", options.poses, "Posed cages (same vertices, same order)")
      ->default_str("the dragon's poses");
  add_method_option(command, [&settings](sym3::Method method) { settings.method = method; });
  add_choice_options(command, settings.choice);
  add_radius_option(command, settings.radius);
  auto asked = std::make_shared<scene::RequestedSettings>();
  add_stitching_options(command, *asked);
  add_rounds_option(command, settings.rounds, "11");
  const auto check = [&options, asked] {
    options.settings.iterations = asked->iterations.value_or(0);
    if ((asked->pins || asked->hold) && !asked->iterations)
      throw CLI::ValidationError(asked->pins ? "--pins" : "--hold", "needs --stitched");
    options.settings.holding = {asked->pins.value_or(0), asked->hold.value_or(0)};
    require_pose(options.model, options.cage, !options.poses.empty());
  };
  finish(command, action, bench, bench_modes, prepare_modes, check);
}

struct MatrixBench {
  const char* name;
  const char* text;
  const char* count;
  std::size_t usual_count;
  std::int64_t most;
  bool has_plot, has_float;
  int (*run)(const BenchOptions&);
};

constexpr MatrixBench matrix_benches[] = {
    {"exp", "Time of exp by method, layout and size", "Matrices", paper_count, most_matrices, true, true,
     run_exp},
    {"eigen", "Time of eigenvalues: QR, Viete's formula and ours", "Matrices", paper_count, most_matrices,
     true, false, run_eigen},
    {"accuracy", "Error of exp by method, eigenvalue gap, spread and scale", "Matrices per row", 4096,
     1'000'000, false, true, run_accuracy},
    {"sym3", "Check every guarantee of exp by kernel and layout", "Matrices in memory", paper_count,
     most_matrices, false, false, run_sym3}};

}  // namespace

void add_bench_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("bench", "Measure speed and accuracy on this machine");
  command->require_subcommand(1);
  add_examples(*command, {"bench exp --plot exp.svg", "bench frame --json frame.json"});
  for (const MatrixBench& bench : matrix_benches) {
    auto* sub = command->add_subcommand(bench.name, bench.text);
    auto options = std::make_shared<BenchOptions>();
    options->count = bench.usual_count;
    whole_in_range(sub->add_option("--count", options->count, bench.count), 1, bench.most)
        ->default_str(base::with_thousands(bench.usual_count));
    add_bench_files(*sub, options->files, bench.has_plot);
    if (bench.has_float) sub->add_flag("--float", options->in_float, "Use single precision");
    sub->callback([options, &action, run = bench.run] {
      action = [options, run] {
        options->files.check();
        require_memory_for(options->count);
        return run(*options);
      };
    });
  }
  const struct {
    const char* name;
    const char* text;
    void (*add)(CLI::App&, Action&);
  } model_benches[] = {{"frame", "Time of a frame by path, cage and stage", add_frame_bench},
                       {"bind", "Time and memory of binding a model", add_bind_bench},
                       {"modes", "Exactness, distortion and cost of every deformer", add_modes_bench}};
  for (const auto& bench : model_benches) bench.add(*command->add_subcommand(bench.name, bench.text), action);
}

}  // namespace viete::bench
