// Times of exp by method, layout and size, errors of exp by ensemble, and the limits of sym3. For comparison,
// also measures copying as many bytes.
#pragma once

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/memory.h"
#include "base/progress.h"
#include "bench/plot.h"
#include "bench/table.h"
#include "sym3/sym3.h"
#include "sym3/view.h"

namespace viete::bench {

/// Many matrices in one of sym3's layouts.
template <class T>
class MatrixArray {
public:
  MatrixArray(sym3::Layout layout, std::size_t count)
      : layout_(layout),
        count_(count),
        stride_(sym3::padded_stride<T>(count)),
        data_(layout == planes ? 6 * stride_ : (layout == full ? 9 : 6) * count) {}

  sym3::SymView<T> view() {
    if (layout_ == planes) return {data_.data(), stride_};
    return {layout_, data_.data()};
  }

  /// Fills the array with these matrices and repeats them as often as necessary.
  void fill(std::span<const sym3::Sym3<T>> matrices) {
    constexpr std::size_t in_full[] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
    const std::size_t size = layout_ == full ? 9 : 6;
    for (std::size_t i = 0; i < count_; ++i) {
      const sym3::Sym3<T>& s = matrices[i % matrices.size()];
      const T entries[6] = {s.xx, s.xy, s.xz, s.yy, s.yz, s.zz};
      for (std::size_t k = 0; k < size; ++k)
        data_[layout_ == planes ? k * stride_ + i : size * i + k] = entries[size == 9 ? in_full[k] : k];
    }
  }

  /// Reads and writes as many bytes as a computation. The time of this copy is a reference.
  void copy_to(MatrixArray& other) const {
    const std::size_t size = layout_ == planes ? count_ : data_.size();
    for (std::size_t from = 0; from < data_.size(); from += layout_ == planes ? stride_ : size)
      std::memcpy(other.data_.data() + from, data_.data() + from, size * sizeof(T));
  }

private:
  static constexpr auto planes = sym3::Layout::planes, full = sym3::Layout::full;
  sym3::Layout layout_;
  std::size_t count_, stride_;
  base::AlignedVector<T> data_;
};

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

/// Measures eigenvalues by QR, Eigen's closed form, Viete's formula and Fast, and eigenvectors without the
/// formula, for the paper's ensemble in double precision on one thread. Times are medians of processor time.
/// Throws base::Cancelled.
EigenBench measure_eigen(std::size_t count, base::Progress& progress);

void print(const EigenBench& bench);
nlohmann::json to_json(const EigenBench& bench);
Plot plot_of(const EigenBench& bench);

/// viete bench sym3: prints the speed and the errors of sym3, one line for each documented limit. Runs that
/// exceed the caches use `count` matrices; 0 means 10,000,000. Throws base::Error.
void bench_sym3(std::size_t count, const std::filesystem::path& json);

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
/// input (sym3/exp.h). If in_float is true, first rounds the input to float. Throws base::Cancelled.
std::vector<AccuracyTable> measure_accuracy(std::size_t samples, bool in_float, base::Progress& progress);

Table errors_table(const AccuracyTable& accuracy);

nlohmann::json to_json(const std::vector<AccuracyTable>& tables);

}  // namespace viete::bench
