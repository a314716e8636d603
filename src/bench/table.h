// Measures in interleaved rounds and gives results as tables and JSON.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/progress.h"

namespace viete::bench {

/// A case to measure. run(round) processes `items` items, which may be different in each round.
struct RoundCase {
  std::string name;
  std::size_t items;
  std::function<void(std::size_t round)> run;
  std::size_t repeats = 1;  ///< runs per round; above 1 if one run is too short for the clock
};

struct BenchResult {
  std::string name;
  double ns_per_item = 0;  ///< median over the rounds, processor time of the calling thread
};

/// Returns the time of the case with this name, or 0 if it is missing.
double time_of(const std::vector<BenchResult>& results, const std::string& name);
/// Returns the time of `slow` divided by the time of `fast`.
double faster(const std::vector<BenchResult>& results, const std::string& slow, const std::string& fast);

/// Runs one warm-up round, then `rounds` rounds. Each round runs all cases, so disturbances affect all cases
/// equally. Times are medians of the calling thread's processor time. Throws base::Cancelled.
std::vector<BenchResult> measure_rounds(const std::vector<RoundCase>& cases, std::size_t rounds,
                                        base::Progress& progress);

/// Rows of text for the terminal and for the report's page. The first column has names. All other columns
/// have right-aligned numbers, except the columns whose names are in `words`.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> words = {};
};
void print(const std::string& title, const Table& table);

/// Returns the times and their ratios to the first time and to the time of "copy".
Table times_table(const std::vector<BenchResult>& results, const std::string& unit = "ns");

/// Returns a text like "4.3e-16".
std::string error_text(double error);
/// Returns a text like "76 %" with a no-break space.
std::string percent(double value);

nlohmann::json to_json(const std::vector<BenchResult>& results);
/// Writes the file atomically. If the path is empty, does nothing. Throws base::Error.
void write_json(const std::filesystem::path& path, const nlohmann::json& json);

/// The limits that one run has checked.
struct Bars {
  nlohmann::json rows = nlohmann::json::array();

  /// Prints whether `measured` is at least `bar`, and adds a row. If `at_least` is false, `measured` must be
  /// at most `bar`.
  void check(const std::string& what, double measured, double bar, bool at_least);
};

}  // namespace viete::bench
