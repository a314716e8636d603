// viete bench exp|eigen|frame|bind|accuracy|sym3: the paper's figures, and its future work, on this machine.
#include <cstdio>
#include <memory>

#include "app/bench_accuracy.h"
#include "app/bench_bind.h"
#include "app/bench_eigen.h"
#include "app/bench_exp.h"
#include "app/bench_sym3.h"
#include "app/command_line.h"
#include "app/frame_bench.h"
#include "app/options.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "base/memory.h"
#include "sym3/kernel.h"

namespace viete::app {

namespace {

struct BenchOptions {
  std::size_t count = 0;
  bool in_float = false;
  BenchFiles files;
};

constexpr std::size_t paper_count = 10'000'000;
constexpr std::int64_t most_matrices = 1'000'000'000;

// Before the system stops the program for it. A matrix comes in and goes out, as nine doubles at most.
void require_memory_for(std::size_t count) {
  base::require_memory({160.0 * static_cast<double>(count), grouped(count) + " matrices take",
                        "give a smaller number", "--count"});
}

template <class Bench>
int report(const Bench& bench, const BenchOptions& options) {
  print(bench);
  write_json(options.files.json, to_json(bench));
  if (!options.files.plot.empty()) base::replace_file(options.files.plot, draw_plot(plot_of(bench)));
  return exit_ok;
}

int bench_exp(const BenchOptions& options) {
  base::Progress progress;
  return report(measure_exp(options.count, options.in_float, progress), options);
}

int bench_eigen(const BenchOptions& options) {
  base::Progress progress;
  return report(measure_eigen(options.count, progress), options);
}

int bench_accuracy(const BenchOptions& options) {
  base::Progress progress;
  const auto tables = measure_accuracy(options.count, options.in_float, progress);
  std::printf("Largest relative error (Frobenius norm) in u = 2^%d against 106 bits, kernel %s\n\n",
              options.in_float ? -24 : -53, std::string(sym3::kernel_name()).c_str());
  for (const auto& table : tables) print(table, options.in_float);
  write_json(options.files.json, to_json(tables));
  return exit_ok;
}

}  // namespace

void add_bench_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("bench", "Measure speed and accuracy on this machine");
  command->require_subcommand(1);
  const struct {
    const char* name;
    const char* text;
    const char* count;
    std::size_t usual_count;
    std::int64_t most;
    bool has_plot, has_float;
    int (*run)(const BenchOptions&);
  } benches[] = {
      {"exp", "Time of exp by method, layout and size", "Matrices", paper_count, most_matrices, true, true,
       bench_exp},
      {"eigen", "Time of eigenvalues by QR, by Viete's formula and by ours", "Matrices", paper_count,
       most_matrices, true, false, bench_eigen},
      {"accuracy", "Error of exp by method, eigenvalue gap, spread and scale", "Matrices a row", 4096,
       1'000'000, false, true, bench_accuracy},
      {"sym3", "Every promise of the core, by kernel and layout", "Matrices from memory", paper_count,
       most_matrices, false, false, [](const BenchOptions& o) { return bench_sym3(o.count, o.files.json); }}};
  for (const auto& bench : benches) {
    auto* sub = command->add_subcommand(bench.name, bench.text);
    auto options = std::make_shared<BenchOptions>();
    options->count = bench.usual_count;
    whole_in_range(sub->add_option("--count", options->count, bench.count), 1, bench.most)
        ->default_str(grouped(bench.usual_count));
    add_bench_files(*sub, options->files, bench.has_plot);
    if (bench.has_float) sub->add_flag("--float", options->in_float, "In single precision");
    sub->callback([options, &action, run = bench.run] {
      action = [options, run] {
        options->files.check();
        require_memory_for(options->count);
        return run(*options);
      };
    });
  }
  add_frame_bench(*command, action);
  add_bind_bench(*command, action);
}

}  // namespace viete::app
