// The methods for exp, and their cost by layout and size, compared with a copy of the same bytes.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "bench/plot.h"
#include "bench/table.h"
#include "sym3/sym3.h"
#include "sym3/view.h"

namespace viete::bench {

struct ExpMethod {
  const char* name;
  sym3::Sym3<double> (*in_double)(const sym3::Sym3<double>&);
  sym3::Sym3<float> (*in_float)(const sym3::Sym3<float>&);
};

/// Diag, Direct (Eigen's closed-form computeDirect instead of QR), SD, Improved SD as printed and guarded,
/// Pade (scaling and squaring, Eigen's unsupported MatrixBase::exp), and Fast, one matrix per call.
std::span<const ExpMethod> exp_methods();

/// One layout and size; nanoseconds per matrix, all from the same interleaved run.
struct LayoutResult {
  sym3::Layout layout;
  std::size_t count = 0;
  double fast = 0, copy = 0, diag = 0, improved_sd = 0;
};

struct ExpBench {
  std::size_t count = 0;
  bool in_float = false;
  std::string kernel;
  std::vector<BenchResult> methods;   ///< Diag, SD, Improved SD, Fast, copy; `count` packed matrices
  std::vector<LayoutResult> layouts;  ///< by layout, then by size from 1024 to `count`
};

/// The paper's ensemble, one thread, processor time, medians. About 100 bytes of memory per matrix, 30 s for
/// 10^7. Throws base::Cancelled.
ExpBench measure_exp(std::size_t count, bool in_float, base::Progress& progress);

struct ExpBar {
  std::string name;
  double ns = 0;      ///< per matrix
  bool ours = false;  ///< false: a reference
};

/// Bars for one plot: the methods, matrices from memory, and our method in the cache.
std::vector<ExpBar> bars_of(const ExpBench& bench);

/// "planes".
const char* layout_name(sym3::Layout layout);

void print(const ExpBench& bench);
nlohmann::json to_json(const ExpBench& bench);
Plot plot_of(const ExpBench& bench);

}  // namespace viete::bench
