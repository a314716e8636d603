// The methods for exp, and their cost by layout and size, compared with a copy of the same bytes; checks of
// all bounds of the core.
#pragma once

#include <cstddef>
#include <filesystem>
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

  sym3::Sym3<double> operator()(const sym3::Sym3<double>& s) const { return in_double(s); }
  sym3::Sym3<float> operator()(const sym3::Sym3<float>& s) const { return in_float(s); }
};

/// Diag, Direct (Eigen's closed-form computeDirect instead of QR), SD, Improved SD as printed and guarded,
/// Pade (scaling and squaring, Eigen's unsupported MatrixBase::exp), and Fast, one matrix per call.
std::span<const ExpMethod> exp_methods();

/// One layout and size, all from the same interleaved run.
struct LayoutResult {
  sym3::Layout layout;
  std::size_t count = 0;
  std::vector<BenchResult> times;  ///< diag, sd, improved_sd, fast, copy
};

/// Throws base::Cancelled.
LayoutResult measure_layout(sym3::Layout layout, std::size_t count, bool in_float, base::Progress& progress);

struct ExpBench {
  std::size_t count = 0;
  bool in_float = false;
  std::string kernel;
  std::vector<BenchResult> methods;   ///< the times of `count` packed matrices
  std::vector<LayoutResult> layouts;  ///< by layout, then by size from 1024 to `count`
};

/// The paper's ensemble, one thread, processor time, medians. About 100 bytes of memory per matrix, 30 s for
/// 10^7. Throws base::Cancelled.
ExpBench measure_exp(std::size_t count, bool in_float, base::Progress& progress);

/// The times of the methods by their labels, and of our method in the cache.
std::vector<BenchResult> labelled_times(const ExpBench& bench);
Table layouts_table(const ExpBench& bench);

void print(const ExpBench& bench);
nlohmann::json to_json(const ExpBench& bench);
Plot plot_of(const ExpBench& bench);

struct EigenBench {
  std::size_t count = 0;
  std::vector<BenchResult> results;
};

/// Cost of eigenvalues by QR, Eigen's closed form, Viete's formula and our method: the paper's ensemble in
/// double, one thread, processor time, medians. Throws base::Cancelled.
EigenBench measure_eigen(std::size_t count, base::Progress& progress);

void print(const EigenBench& bench);
nlohmann::json to_json(const EigenBench& bench);
Plot plot_of(const EigenBench& bench);

/// viete bench sym3: prints speed and error of the core, one line per documented limit. `count`: number of
/// matrices for runs from memory, 0 for 10,000,000. Throws base::Error.
void bench_sym3(std::size_t count, const std::filesystem::path& json);

}  // namespace viete::bench
