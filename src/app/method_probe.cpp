#include "app/method_probe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/clock.h"
#include "bench/rounds.h"
#include "sym3/exp.h"
#include "sym3/reference.h"

namespace viete::app {

namespace {

constexpr double pause_seconds = 0.33;
constexpr int rounds = 5;
constexpr std::size_t method_count = scene::compared_methods.size();
using Matrix = sym3::Sym3<double>;

scene::MethodSample errors_of(std::span<const Matrix> computed, std::span<const Matrix> matrices) {
  std::vector<double> errors(matrices.size());
  bool has_nan = false;
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    errors[i] = sym3::relative_error(computed[i], matrices[i]);
    has_nan |= std::isnan(errors[i]);
  }
  scene::MethodSample sample;
  sample.worst_error = has_nan ? std::nan("") : *std::max_element(errors.begin(), errors.end());
  sample.median_error = has_nan ? std::nan("") : bench::median(std::move(errors));
  return sample;
}

std::vector<Matrix> spread_sample(std::span<const Matrix> matrices) {
  const std::size_t count = std::min(matrices.size(), probe_limit);
  std::vector<Matrix> sample(count);
  for (std::size_t i = 0; i < count; ++i) sample[i] = matrices[i * matrices.size() / count];
  return sample;
}

}  // namespace

scene::MethodStats measure_methods(std::span<const Matrix> matrices) {
  scene::MethodStats stats;
  if (matrices.empty()) return stats;
  std::vector<Matrix> out(matrices.size());
  std::array<std::vector<double>, method_count> seconds;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t m = 0; m < method_count; ++m) {
      const double start = base::thread_seconds();
      sym3::exp<double>(matrices, out, scene::compared_methods[m]);
      seconds[m].push_back(base::thread_seconds() - start);
      if (round == 0) stats.samples[m] = errors_of(out, matrices);
    }
  }
  for (std::size_t m = 0; m < method_count; ++m) {
    stats.samples[m].ns_per_matrix = 1e9 * bench::median(seconds[m]) / static_cast<double>(matrices.size());
  }
  stats.matrices = matrices.size();
  return stats;
}

MethodProbe::MethodProbe() : thread_([this] { serve(); }) {}

MethodProbe::~MethodProbe() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void MethodProbe::serve() {
  for (;;) {
    std::vector<Matrix> sample;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return stop_ || busy_; });
      if (stop_) return;
      sample = std::move(sample_);
    }
    const scene::MethodStats stats = measure_methods(sample);
    const std::lock_guard lock(mutex_);
    result_ = stats;
    busy_ = false;
    last_ = base::wall_seconds();
  }
}

bool MethodProbe::ready() const {
  const std::lock_guard lock(mutex_);
  return !busy_ && base::wall_seconds() - last_ > pause_seconds;
}

bool MethodProbe::busy() const {
  const std::lock_guard lock(mutex_);
  return busy_;
}

bool MethodProbe::has_result() const {
  const std::lock_guard lock(mutex_);
  return result_.has_value();
}

void MethodProbe::offer(std::span<const Matrix> matrices) {
  {
    const std::lock_guard lock(mutex_);
    sample_ = spread_sample(matrices);
    busy_ = true;
  }
  wake_.notify_one();
}

std::optional<scene::MethodStats> MethodProbe::poll() {
  const std::lock_guard lock(mutex_);
  return std::exchange(result_, std::nullopt);
}

}  // namespace viete::app
