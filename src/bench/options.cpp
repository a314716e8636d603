#include "bench/options.h"

#include <cstdio>
#include <memory>

#include "app/assets.h"
#include "app/inputs.h"
#include "base/text.h"
#include "bench/exp.h"
#include "bench/frame.h"
#include "bench/modes.h"
#include "foreign/read.h"
#include "sym3/kernel.h"

namespace viete::bench {

namespace {

using namespace app;

struct MatrixOptions {
  std::size_t count = 0;
  bool in_float = false, force = false;
  std::filesystem::path json;  // file for the numbers; if empty, no file is written
};

template <class Options>
void add_json_options(CLI::App& command, Options& options) {
  add_file_option(command, "--json", options.json, "Write the numbers to this JSON file");
  add_force_option(command, options.force);
  add_examples(command, {"bench " + command.get_name() + " --json " + command.get_name() + ".json"});
}

constexpr std::size_t paper_count = 10'000'000;
constexpr std::int64_t most_matrices = 1'000'000'000;

// Throws if memory is not sufficient. The input and the output have at most nine doubles per matrix.
void require_memory_for(std::size_t count) {
  base::require_memory({160.0 * static_cast<double>(count), base::with_thousands(count) + " matrices take",
                        "give a smaller number", "--count"});
}

void run_exp(const MatrixOptions& options, base::Progress& progress) {
  const ExpBench bench = measure_exp(options.count, options.in_float, progress);
  print(bench);
  write_json(options.json, to_json(bench));
}

void run_eigen(const MatrixOptions& options, base::Progress& progress) {
  const EigenBench bench = measure_eigen(options.count, progress);
  print(bench);
  write_json(options.json, to_json(bench));
}

void run_sym3(const MatrixOptions& options, base::Progress&) {
  bench_sym3(options.count, options.json);
}

void run_accuracy(const MatrixOptions& options, base::Progress& progress) {
  const auto tables = measure_accuracy(options.count, options.in_float, progress);
  std::printf("Largest relative error (Frobenius norm), compared with 106-bit results, kernel %s\n",
              std::string(sym3::kernel_name()).c_str());
  for (const auto& table : tables) print(table.title, errors_table(table));
  write_json(options.json, {{"figure", "accuracy"}, {"tables", to_json(tables)}});
}

std::shared_ptr<ModelOptions> add_model_bench(CLI::App& command, std::size_t rounds, const char* usual_cage) {
  auto shared = std::make_shared<ModelOptions>();
  ModelOptions& options = *shared;
  options.rounds = rounds;
  add_file_option(command, "MODEL", options.model, foreign::a_mesh())->default_str("the bundled dragon");
  add_file_option(command, "CAGE", options.cage, "Cage at rest")->default_str(usual_cage);
  whole_in_range(
      command.add_option("--rounds", options.rounds, "Number of times to repeat every measurement"), 1, 1000)
      ->default_str(std::to_string(rounds));
  add_json_options(command, options);
  return shared;
}

// Checks the files. If no model is given, uses the bundled model.
void prepare(ModelOptions& options, bool posed) {
  FilesInUse inputs{options.model, options.cage};
  for (const auto& pose : options.poses) inputs.add(pose, document::the_pose);
  check_output(options.json, Content::json, inputs, options.force);
  if (!options.model.empty()) return;
  const BundledModel bundled = bundled_model();
  options.model = bundled.model;
  if (posed) {
    options.cage = bundled.cage;
    options.poses = bundled.poses;
  }
}

void add_sized_bench(CLI::App& command, Action& action, std::vector<std::size_t> faces, std::size_t rounds,
                     void (*run)(const ModelOptions&)) {
  auto bench = add_model_bench(command, rounds, "generated cages, see --faces");
  ModelOptions& options = *bench;
  options.faces = std::move(faces);
  whole_in_range(command.add_option("--vertices", options.count,
                                    "Truncate or subdivide the model to about this number of vertices"),
                 1, 20'000'000)
      ->default_str("all");
  std::string usual;
  for (const std::size_t count : options.faces) usual += (usual.empty() ? "" : ",") + std::to_string(count);
  whole_in_range(command.add_option("--faces", options.faces, "Numbers of cage triangles, comma-separated"),
                 8, 10'000)
      ->delimiter(',')
      ->allow_extra_args(false)
      ->default_str(usual)
      ->excludes("CAGE");
  command.callback([=, &action] {
    action = [=] {
      prepare(*bench, false);
      run(*bench);
      return exit_ok;
    };
  });
}

void add_splats_bench(CLI::App& command, Action& action) {
  auto bench = add_model_bench(command, 11, "the dragon's cage");
  bench->count = 1'000'000;
  whole_in_range(command.add_option("--count", bench->count, "Number of splats"), 1000, 10'000'000)
      ->default_str(base::with_thousands(bench->count));
  command.callback([=, &action] {
    if (!bench->model.empty() && bench->cage.empty()) throw CLI::RequiredError("CAGE");
    action = [=] {
      prepare(*bench, true);
      bench_splats(*bench);
      return exit_ok;
    };
  });
}

void add_modes_bench(CLI::App& command, Action& action) {
  auto bench = add_model_bench(command, 11, "the dragon's cage");
  auto settings = std::make_shared<ModeSettings>();
  auto asked = std::make_shared<pose::AskedDeformer>();
  command.add_option("POSE", bench->poses, "Posed cages (same vertices, same order)")
      ->default_str("the dragon's poses");
  add_method_option(command, [settings](sym3::Method method) { settings->method = method; });
  add_choice_options(command, settings->choice);
  add_number_option(command, "radius", *asked);
  add_arap_options(command, *asked);
  command.callback([=, &action] {
    settings->radius = asked->radius;
    if ((asked->iterations || asked->attach || asked->hold) && !asked->arap)
      throw CLI::RequiredError("--arap");
    settings->iterations = asked->arap ? asked->iterations.value_or(1) : 0;
    settings->holding = {asked->attach.value_or(0), asked->hold.value_or(0)};
    const ModelOptions& options = *bench;
    if (!options.model.empty() && options.poses.empty())
      throw CLI::RequiredError(options.cage.empty() ? "CAGE" : "POSE");
    action = [=] {
      prepare(*bench, true);
      bench_modes(*bench, *settings);
      return exit_ok;
    };
  });
}

struct MatrixBench {
  const char* name;
  const char* text;
  const char* count;
  std::size_t usual_count;
  std::int64_t most;
  bool has_float;
  void (*run)(const MatrixOptions&, base::Progress&);
};

constexpr MatrixBench matrix_benches[] = {
    {"exp", "Measure the time of exp by method, layout and size", "Number of matrices", paper_count,
     most_matrices, true, run_exp},
    {"eigen", "Measure the time of eigenvalues and eigenvectors", "Number of matrices", paper_count,
     most_matrices, false, run_eigen},
    {"accuracy", "Measure the error of exp by method, eigenvalue gap, spread and scale",
     "Number of matrices per row", 4096, 1'000'000, true, run_accuracy},
    {"sym3", "Check every guarantee of exp by kernel and layout", "Number of matrices in memory", paper_count,
     most_matrices, false, run_sym3}};

void add_matrix_bench(CLI::App& command, Action& action, const MatrixBench& bench) {
  auto options = std::make_shared<MatrixOptions>();
  options->count = bench.usual_count;
  whole_in_range(command.add_option("--count", options->count, bench.count), 1, bench.most)
      ->default_str(base::with_thousands(bench.usual_count));
  add_json_options(command, *options);
  if (bench.has_float) command.add_flag("--float", options->in_float, "Use single precision");
  command.callback([options, &action, run = bench.run] {
    action = [options, run] {
      check_output(options->json, Content::json, {}, options->force);
      require_memory_for(options->count);
      base::Progress progress;
      run(*options, progress);
      return exit_ok;
    };
  });
}

}  // namespace

void add_bench_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("bench", bench_text);
  command->require_subcommand(1);
  for (const MatrixBench& bench : matrix_benches)
    add_matrix_bench(*command->add_subcommand(bench.name, bench.text), action, bench);
  add_sized_bench(*command->add_subcommand("frame", "Measure the time of a frame by engine, cage and stage"),
                  action, {50, 100, 300, 600}, 11, bench_frame);
  add_sized_bench(*command->add_subcommand("bind", "Measure the time and memory of binding a model"), action,
                  {300}, 5, bench_bind);
  add_splats_bench(*command->add_subcommand("splats", "Measure the time of a frame of Gaussian splats"),
                   action);
  add_modes_bench(*command->add_subcommand("modes", "Measure exactness, energy and cost of every deformer"),
                  action);
  add_examples(*command, {"bench exp --json exp.json", "bench frame --json frame.json"});
}

}  // namespace viete::bench
