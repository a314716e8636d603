// Options of the benchmarks on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "app/command_line.h"
#include "app/inputs.h"

namespace viete::bench {

/// Output files of a benchmark; empty: none.
struct BenchFiles {
  std::filesystem::path json, plot;
  bool force = false;

  /// As check_output(); the files must differ from each other and from `inputs`.
  void check(const app::FilesInUse& inputs = {}) const;
};

/// --rounds, 1 to 1,000.
void add_rounds_option(CLI::App& app, std::size_t& rounds, const char* usual);
/// Limit of the subdivision of a benchmark's model.
constexpr std::int64_t most_vertices = 20'000'000;
/// Adds --json, --force and, if requested, --plot.
void add_bench_files(CLI::App& app, BenchFiles& files, bool has_plot = false);

void add_bench_command(CLI::App& app, app::Action& action);

}  // namespace viete::bench
