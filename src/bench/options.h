// Options of the benchmarks on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "app/command_line.h"
#include "app/inputs.h"

namespace viete::bench {

/// Where the numbers of a benchmark go; empty: nowhere.
struct BenchFiles {
  std::filesystem::path json, plot;
  bool force = false;

  /// As check_output(); neither may be the other, nor one of `inputs`.
  void check(const app::FilesInUse& inputs = {}) const;
};

/// --rounds, 1 to 1,000.
void add_rounds_option(CLI::App& app, std::size_t& rounds, const char* usual);
/// Vertices of a benchmark's model, which is subdivided until it has so many.
constexpr std::int64_t most_vertices = 10'000'000;
/// --json, --force and, if asked for, --plot.
void add_bench_files(CLI::App& app, BenchFiles& files, bool has_plot = false);

void add_bench_command(CLI::App& app, app::Action& action);

}  // namespace viete::bench
