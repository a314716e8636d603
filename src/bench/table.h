// How what was measured is printed and written.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/rounds.h"

namespace viete::bench {

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
