#include "bench/table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "base/atomic_file.h"
#include "base/clock.h"
#include "base/median.h"

namespace viete::bench {

double time_of(const std::vector<BenchResult>& results, const std::string& name) {
  for (const auto& r : results) {
    if (r.name == name) return r.ns_per_item;
  }
  return 0;
}

std::vector<BenchResult> measure_rounds(const std::vector<RoundCase>& cases, std::size_t rounds,
                                        base::Progress& progress) {
  std::vector<std::vector<double>> times(cases.size());
  const auto runs = static_cast<double>((rounds + 1) * cases.size());
  for (std::size_t round = 0; round <= rounds; ++round) {
    for (std::size_t c = 0; c < cases.size(); ++c) {
      const double start = base::thread_seconds();
      cases[c].run(round);
      const double seconds = base::thread_seconds() - start;
      if (round > 0) times[c].push_back(1e9 * seconds / static_cast<double>(cases[c].items));
      progress.report(static_cast<double>(round * cases.size() + c + 1) / runs);
    }
  }
  std::vector<BenchResult> results;
  for (std::size_t c = 0; c < cases.size(); ++c)
    results.push_back({cases[c].name, base::median(std::move(times[c]))});
  return results;
}

void print_table(const std::string& title, const std::vector<BenchResult>& results,
                 const std::string& reference, const std::string& copy) {
  const double base = time_of(results, reference), bytes = time_of(results, copy);
  std::printf("%s\n  %-14s %10s %12s %10s\n", title.c_str(), "", "ns", ("x " + reference).c_str(), "x copy");
  for (const auto& r : results) {
    std::printf("  %-14s %10.2f %12.2f %10.1f\n", r.name.c_str(), r.ns_per_item, base / r.ns_per_item,
                r.ns_per_item / bytes);
  }
}

nlohmann::json to_json(const std::vector<BenchResult>& results) {
  nlohmann::json json = nlohmann::json::array();
  for (const auto& r : results) json.push_back({{"name", r.name}, {"ns", r.ns_per_item}});
  return json;
}

void write_json(const std::filesystem::path& path, const nlohmann::json& json) {
  if (path.empty()) return;
  base::replace_file(path, json.dump(2) + '\n');
}

std::string processor_name() {
  std::ifstream lines("/proc/cpuinfo");
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(std::min(line.find(':') + 2, line.size()));
  }
  return "";
}

void Bars::check(const std::string& what, double measured, double bar, bool at_least) {
  const bool met = at_least ? measured >= bar : measured <= bar;
  const char* format =
      std::abs(measured) < 0.01 ? "  %-58s %8.1e   %s %-6g %s\n" : "  %-58s %8.2f   %s %-6g %s\n";
  std::printf(format, what.c_str(), measured, at_least ? ">=" : "<=", bar, met ? "met" : "NOT MET");
  rows.push_back({{"what", what}, {"measured", measured}, {"bar", bar}, {"met", met}});
}

}  // namespace viete::bench
