// How exact each way to exp is, by ensemble, eigenvalue gap, spread and scale.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/progress.h"

namespace viete::bench {

/// Of one method on one ensemble.
struct Accuracy {
  double worst = 0;      ///< largest relative Frobenius error over those that gave numbers
  double nan_share = 0;  ///< of answers with NaN or infinity, where the true answer is in range
};

struct AccuracyTable {
  std::string title, by;  ///< what the rows are
  struct Row {
    std::string name;
    double value = 0;             ///< the gap, spread or scale; 0 for ensembles
    std::vector<Accuracy> cells;  ///< one for each of exp_methods()
  };
  std::vector<Row> rows;
};

/// All tables, `samples` matrices a row, against the 106 bits of sym3/reference.h. In float the input is
/// rounded to float first, and the error is that of the rounded input's exp. Throws base::Cancelled.
std::vector<AccuracyTable> measure_accuracy(std::size_t samples, bool in_float, base::Progress& progress);

/// As Markdown, in units of the roundoff u: 2^-53, for float 2^-24.
void print(const AccuracyTable& table, bool in_float);

nlohmann::json to_json(const std::vector<AccuracyTable>& tables);

}  // namespace viete::bench
