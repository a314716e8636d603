// Accuracy of each method for exp, by ensemble, gap between eigenvalues, spread and scale.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/progress.h"
#include "bench/table.h"

namespace viete::bench {

/// Results of one method for one ensemble.
struct Accuracy {
  double worst = 0;      ///< largest relative Frobenius error of the finite results
  double nan_share = 0;  ///< part of the results that are NaN or infinite, from 0 to 1
};

struct AccuracyTable {
  std::string title, by;  ///< `by` is the quantity that differs between rows, for example "gap"
  struct Row {
    std::string name;
    double value = 0;             ///< the gap, spread or scale; 0 for ensembles
    std::vector<Accuracy> cells;  ///< one cell for each entry of exp_methods()
  };
  std::vector<Row> rows;
};

/// Measures all tables with `samples` matrices per row. Errors are relative to 106-bit results of the same
/// input (sym3/reference.h). If in_float is true, first rounds the input to float. Throws base::Cancelled.
std::vector<AccuracyTable> measure_accuracy(std::size_t samples, bool in_float, base::Progress& progress);

Table errors_table(const AccuracyTable& accuracy);

nlohmann::json to_json(const std::vector<AccuracyTable>& tables);

}  // namespace viete::bench
