// What was measured, and how it is printed.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace viete::bench {

struct BenchResult {
  std::string name;
  double ns_per_item = 0;  ///< median over the rounds, processor time of the calling thread
};

/// The time of the case of that name; 0 if there is none.
double time_of(const std::vector<BenchResult>& results, const std::string& name);

/// name, ns per item, and how many times the time of `copy` and how much faster than `reference`.
void print_table(const std::string& title, const std::vector<BenchResult>& results,
                 const std::string& reference, const std::string& copy);

nlohmann::json to_json(const std::vector<BenchResult>& results);
/// Atomic. Throws base::Error. Does nothing for an empty path.
void write_json(const std::filesystem::path& path, const nlohmann::json& json);

}  // namespace viete::bench
