// Cost of eigenvalues: by QR, by Eigen's closed form, by Viete's formula, and by our method.
#pragma once

#include "base/progress.h"
#include "bench/plot.h"
#include "bench/table.h"

namespace viete::bench {

struct EigenBench {
  std::size_t count = 0;
  std::vector<BenchResult> results;
};

/// The paper's ensemble in double, one thread, processor time, medians. Throws base::Cancelled.
EigenBench measure_eigen(std::size_t count, base::Progress& progress);

void print(const EigenBench& bench);
nlohmann::json to_json(const EigenBench& bench);
Plot plot_of(const EigenBench& bench);

}  // namespace viete::bench
