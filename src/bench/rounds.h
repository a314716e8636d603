// Round by round every case in turn, until the medians can be trusted.
#pragma once

#include <cstddef>
#include <functional>
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

}  // namespace viete::bench
