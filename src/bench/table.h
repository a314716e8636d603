// Interleaved rounds of measurements, and how their results are printed and written.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/progress.h"

namespace viete::bench {

/// One thing that is measured: run(round) does `items` of it, of which there may be others each round.
struct RoundCase {
  std::string name;
  std::size_t items;
  std::function<void(std::size_t round)> run;
};

struct BenchResult {
  std::string name;
  double ns_per_item = 0;  ///< median over the rounds, processor time of the calling thread
};

/// The time of the case of that name; 0 if there is none.
double time_of(const std::vector<BenchResult>& results, const std::string& name);

/// Every case once a round, so that a disturbance hits all alike; one round more before, which does not
/// count. Processor time of the calling thread, medians. Throws base::Cancelled.
std::vector<BenchResult> measure_rounds(const std::vector<RoundCase>& cases, std::size_t rounds,
                                        base::Progress& progress);

/// name, ns per item, and how many times the time of `copy` and how much faster than `reference`.
void print_table(const std::string& title, const std::vector<BenchResult>& results,
                 const std::string& reference, const std::string& copy);

nlohmann::json to_json(const std::vector<BenchResult>& results);
/// Atomic. Throws base::Error. Does nothing for an empty path.
void write_json(const std::filesystem::path& path, const nlohmann::json& json);

/// "AMD EPYC 9654", or nothing where the system does not say.
std::string processor_name();

/// The bars of one run, in the order in which they were checked.
struct Bars {
  nlohmann::json rows = nlohmann::json::array();

  /// Prints a line: at least, or at most, `bar`; met or not.
  void check(const std::string& what, double measured, double bar, bool at_least);
};

}  // namespace viete::bench
