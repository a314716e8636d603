// Interleaved rounds of measurements; printing and writing of their results.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/progress.h"

namespace viete::bench {

/// One measured case: run(round) processes `items` items, which may differ per round.
struct RoundCase {
  std::string name;
  std::size_t items;
  std::function<void(std::size_t round)> run;
};

struct BenchResult {
  std::string name;
  double ns_per_item = 0;  ///< median over the rounds, processor time of the calling thread
};

/// The time of the case with this name; 0 if there is none.
double time_of(const std::vector<BenchResult>& results, const std::string& name);

/// Runs every case once per round, so that disturbances affect all alike, after one warm-up round. Processor
/// time of the calling thread, medians. Throws base::Cancelled.
std::vector<BenchResult> measure_rounds(const std::vector<RoundCase>& cases, std::size_t rounds,
                                        base::Progress& progress);

/// Prints name, ns per item, the ratio to the time of `copy`, and the speedup over `reference`.
void print_table(const std::string& title, const std::vector<BenchResult>& results,
                 const std::string& reference, const std::string& copy);

nlohmann::json to_json(const std::vector<BenchResult>& results);
/// Atomic. Throws base::Error. Does nothing for an empty path.
void write_json(const std::filesystem::path& path, const nlohmann::json& json);

/// "AMD EPYC 9654"; empty if the system does not report it.
std::string processor_name();

/// The checked limits of one run, in order.
struct Bars {
  nlohmann::json rows = nlohmann::json::array();

  /// Prints whether `measured` is at least, or at most, `bar`.
  void check(const std::string& what, double measured, double bar, bool at_least);
};

}  // namespace viete::bench
