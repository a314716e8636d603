#include "app/bench_table.h"

#include <algorithm>
#include <cstdio>

#include "base/atomic_file.h"
#include "base/clock.h"

namespace viete::app {

namespace {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

double time_of(const std::vector<BenchResult>& results, const std::string& name) {
  for (const auto& r : results) {
    if (r.name == name) return r.ns_per_item;
  }
  return 0;
}

std::vector<BenchResult> interleave(const std::vector<BenchCase>& cases, std::size_t pieces, std::size_t items_per_piece,
                                    int passes) {
  std::vector<std::vector<double>> times(cases.size());
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t piece = 0; piece < pieces; ++piece) {
      for (std::size_t c = 0; c < cases.size(); ++c) {
        const double start = base::thread_seconds();
        for (int r = 0; r < cases[c].repeats; ++r) cases[c].run(piece);
        const double seconds = (base::thread_seconds() - start) / cases[c].repeats;
        times[c].push_back(1e9 * seconds / static_cast<double>(items_per_piece));
      }
    }
  }
  std::vector<BenchResult> results;
  for (std::size_t c = 0; c < cases.size(); ++c) results.push_back({cases[c].name, median(std::move(times[c]))});
  return results;
}

void print_table(const std::string& title, const std::vector<BenchResult>& results, const std::string& reference,
                 const std::string& copy) {
  const double base = time_of(results, reference), bytes = time_of(results, copy);
  std::printf("%s\n  %-14s %10s %12s %10s\n", title.c_str(), "", "ns", ("x " + reference).c_str(), "x copy");
  for (const auto& r : results) {
    std::printf("  %-14s %10.2f %12.2f %10.1f\n", r.name.c_str(), r.ns_per_item, base / r.ns_per_item, r.ns_per_item / bytes);
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

}  // namespace viete::app
