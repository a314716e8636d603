// Interleaved measurements, their medians, and how they are printed.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace viete::app {

/// One thing that is measured: run(i) does the i-th piece of work of `items` items.
struct BenchCase {
  std::string name;
  std::function<void(std::size_t piece)> run;
  int repeats = 1;  ///< times in a row, for what is too short to time; the time is of one
};

struct BenchResult {
  std::string name;
  double ns_per_item = 0;  ///< median over the pieces, processor time of the calling thread
};

/// For each piece in turn every case runs once (so that a disturbance hits all alike); `passes` times over.
std::vector<BenchResult> interleave(const std::vector<BenchCase>& cases, std::size_t pieces, std::size_t items_per_piece, int passes);

/// The time of the case of that name; 0 if there is none.
double time_of(const std::vector<BenchResult>& results, const std::string& name);

/// name, ns per item, and how many times the time of `copy` and how much faster than `reference`.
void print_table(const std::string& title, const std::vector<BenchResult>& results, const std::string& reference, const std::string& copy);

nlohmann::json to_json(const std::vector<BenchResult>& results);
/// Atomic. Throws base::Error. Does nothing for an empty path.
void write_json(const std::filesystem::path& path, const nlohmann::json& json);

}  // namespace viete::app
