#include "bench/rounds.h"

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

}  // namespace viete::bench
