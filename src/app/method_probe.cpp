#include "app/method_probe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "base/clock.h"
#include "base/median.h"
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
  for (std::size_t i = 0; i < matrices.size(); ++i)
    errors[i] = sym3::relative_error(computed[i], matrices[i]);
  scene::MethodSample sample;
  std::tie(sample.worst_error, sample.median_error) = worst_and_median(std::move(errors));
  return sample;
}

}  // namespace

std::pair<double, double> worst_and_median(std::vector<double> errors) {
  if (errors.empty()) return {0, 0};
  if (std::ranges::any_of(errors, [](double e) { return std::isnan(e); }))
    return {std::nan(""), std::nan("")};
  const double worst = std::ranges::max(errors);
  return {worst, base::median(std::move(errors))};
}

std::vector<Matrix> spread_sample(std::span<const Matrix> matrices, std::size_t most) {
  const std::size_t count = std::min(matrices.size(), most);
  std::vector<Matrix> sample(count);
  for (std::size_t i = 0; i < count; ++i) sample[i] = matrices[i * matrices.size() / count];
  return sample;
}

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
    stats.samples[m].ns_per_matrix = 1e9 * base::median(seconds[m]) / static_cast<double>(matrices.size());
  }
  stats.matrices = matrices.size();
  return stats;
}

bool MethodProbe::ready() const {
  return !job_.running() && base::wall_seconds() - last_ > pause_seconds;
}

void MethodProbe::offer(std::span<const Matrix> matrices) {
  job_.start(
      [sample = spread_sample(matrices, probe_limit)](base::Progress&) { return measure_methods(sample); });
}

std::optional<scene::MethodStats> MethodProbe::poll(bool wait) {
  const auto result = job_.poll(wait);
  if (!result) return std::nullopt;
  last_ = base::wall_seconds();
  return result->value;
}

}  // namespace viete::app
