#include "bench/table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "base/atomic_file.h"
#include "base/clock.h"
#include "base/median.h"
#include "base/text.h"

namespace viete::bench {

double time_of(const std::vector<BenchResult>& results, const std::string& name) {
  for (const auto& r : results)
    if (r.name == name) return r.ns_per_item;
  return 0;
}

double faster(const std::vector<BenchResult>& results, const std::string& slow, const std::string& fast) {
  return time_of(results, slow) / time_of(results, fast);
}

std::vector<BenchResult> measure_rounds(const std::vector<RoundCase>& cases, std::size_t rounds,
                                        base::Progress& progress) {
  std::vector<std::vector<double>> times(cases.size());
  const auto runs = static_cast<double>((rounds + 1) * cases.size());
  for (std::size_t round = 0; round <= rounds; ++round)
    for (std::size_t c = 0; c < cases.size(); ++c) {
      const double start = base::thread_seconds();
      for (std::size_t i = 0; i < cases[c].repeats; ++i) cases[c].run(round);
      const double seconds = base::thread_seconds() - start;
      const auto items = static_cast<double>(cases[c].items * cases[c].repeats);
      if (round > 0) times[c].push_back(1e9 * seconds / items);
      progress.report(static_cast<double>(round * cases.size() + c + 1) / runs);
    }
  std::vector<BenchResult> results;
  for (std::size_t c = 0; c < cases.size(); ++c)
    results.push_back({cases[c].name, base::median(std::move(times[c]))});
  return results;
}

namespace {

std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

void print(const std::string& title, const Table& table) {
  std::vector<std::vector<std::string>> lines = {table.columns};
  lines.insert(lines.end(), table.rows.begin(), table.rows.end());
  std::vector<std::size_t> widths(table.columns.size());
  for (const auto& line : lines)
    for (std::size_t c = 0; c < line.size(); ++c) widths[c] = std::max(widths[c], width(line[c]));
  std::printf("\n%s\n", title.c_str());
  for (const auto& line : lines) {
    std::string text;
    for (std::size_t c = 0; c < line.size(); ++c) {
      const std::string space(widths[c] - width(line[c]), ' ');
      text += "  " + (c == 0 ? line[c] + space : space + line[c]);
    }
    std::printf("%s\n", text.c_str());
  }
}

Table times_table(const std::vector<BenchResult>& results, const std::string& unit) {
  const double copy = time_of(results, "copy"), first = results.front().ns_per_item;
  Table table{{"", unit, "times faster than " + results.front().name}, {}};
  if (copy > 0) table.columns.emplace_back("times the copy");
  for (const BenchResult& r : results) {
    table.rows.push_back({r.name, base::few_digits(r.ns_per_item), base::few_digits(first / r.ns_per_item)});
    if (copy > 0) table.rows.back().push_back(base::few_digits(r.ns_per_item / copy));
  }
  return table;
}

std::string error_text(double error) {
  std::string result = base::formatted("%.1e", error);
  if (const auto zero = result.find("e-0"); zero != result.npos) result.erase(zero + 2, 1);
  return result;
}

std::string percent(double value) {
  return std::to_string(std::lround(value)) + "\u00a0%";
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

void Bars::check(const std::string& what, double measured, double bar, bool at_least) {
  const bool met = at_least ? measured >= bar : measured <= bar;
  const char* format =
      std::abs(measured) < 0.01 ? "  %-58s %8.1e   %s %-6g %s\n" : "  %-58s %8.2f   %s %-6g %s\n";
  std::printf(format, what.c_str(), measured, at_least ? ">=" : "<=", bar, met ? "met" : "NOT MET");
  rows.push_back({{"what", what}, {"measured", measured}, {"bar", bar}, {"met", met}});
}

}  // namespace viete::bench
