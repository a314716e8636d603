// Accuracy of each method for exp, by ensemble, eigenvalue gap, spread and scale.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/progress.h"

namespace viete::bench {

/// Results of one method on one ensemble.
struct Accuracy {
  double worst = 0;      ///< largest relative Frobenius error of the finite results
  double nan_share = 0;  ///< share of results with NaN or infinity although the true result is in range
};

struct AccuracyTable {
  std::string title, by;  ///< title, and the meaning of the rows
  struct Row {
    std::string name;
    double value = 0;             ///< the gap, spread or scale; 0 for ensembles
    std::vector<Accuracy> cells;  ///< one per exp_methods() entry
  };
  std::vector<Row> rows;
};

/// All tables, `samples` matrices per row, against the 106 bits of sym3/reference.h. In float the input is
/// first rounded to float, and the error refers to exp of the rounded input. Throws base::Cancelled.
std::vector<AccuracyTable> measure_accuracy(std::size_t samples, bool in_float, base::Progress& progress);

/// Prints the table as Markdown. Errors are in units of the roundoff u: 2^-53, or 2^-24 for float.
void print(const AccuracyTable& table, bool in_float);

nlohmann::json to_json(const std::vector<AccuracyTable>& tables);

}  // namespace viete::bench
