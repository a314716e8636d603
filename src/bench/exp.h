// Measures the time of exp by method, layout and size. For comparison, also measures copying as many bytes.
// Checks the limits of sym3.
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

/// The methods for one matrix: all of sym3::Method, "Direct" (like Diag, but with Eigen's closed-form
/// computeDirect instead of QR) and "Pade" (Eigen's unsupported MatrixBase::exp).
std::span<const ExpMethod> exp_methods();

/// Times for one layout and size, measured in one interleaved run.
struct LayoutResult {
  sym3::Layout layout;
  std::size_t count = 0;
  std::vector<BenchResult> times;  ///< for diag, sd, improved_sd, fast and copy
};

/// Measures one layout with `count` matrices. Throws base::Cancelled.
LayoutResult measure_layout(sym3::Layout layout, std::size_t count, bool in_float, base::Progress& progress);

struct ExpBench {
  std::size_t count = 0;
  bool in_float = false;
  std::string kernel;
  std::vector<BenchResult> methods;   ///< the times of `count` packed matrices
  std::vector<LayoutResult> layouts;  ///< sorted by layout, then by size from 1024 to `count`
};

/// Measures the paper's ensemble on one thread. Times are medians of processor time. The memory is about 100
/// bytes per matrix; 10^7 matrices take 30 s. Throws base::Cancelled.
ExpBench measure_exp(std::size_t count, bool in_float, base::Progress& progress);

/// Returns the times of the methods with their labels, and the time of Fast for matrices in the cache.
std::vector<BenchResult> labelled_times(const ExpBench& bench);
Table layouts_table(const ExpBench& bench);

void print(const ExpBench& bench);
nlohmann::json to_json(const ExpBench& bench);
Plot plot_of(const ExpBench& bench);

struct EigenBench {
  std::size_t count = 0;
  std::vector<BenchResult> results;
};

/// Measures eigenvalues by QR, Eigen's closed form, Viete's formula and Fast, for the paper's ensemble in
/// double precision on one thread. Times are medians of processor time. Throws base::Cancelled.
EigenBench measure_eigen(std::size_t count, base::Progress& progress);

void print(const EigenBench& bench);
nlohmann::json to_json(const EigenBench& bench);
Plot plot_of(const EigenBench& bench);

/// viete bench sym3: prints the speed and the errors of sym3, one line for each documented limit. Runs that
/// exceed the caches use `count` matrices; 0 means 10,000,000. Throws base::Error.
void bench_sym3(std::size_t count, const std::filesystem::path& json);

}  // namespace viete::bench
