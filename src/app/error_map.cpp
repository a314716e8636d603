#include "app/error_map.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "app/method_probe.h"
#include "sym3/reference.h"

namespace viete::app {

namespace {

constexpr std::size_t portion = 1024;

// The decades up to the worst of all methods, on some of the matrices: the same ones whichever method runs.
void fit_range(std::span<const sym3::Sym3<double>> matrices, scene::ErrorMapStats& stats) {
  constexpr std::size_t most = 4096;
  constexpr double floor = 1e-17, fewest_decades = 2;
  const std::vector<sym3::Sym3<double>> sample = spread_sample(matrices, most);
  std::vector<sym3::Sym3<double>> computed(sample.size());
  double worst = floor;
  for (const sym3::Method method : scene::compared_methods) {
    sym3::exp<double>(sample, computed, method);
    for (std::size_t i = 0; i < sample.size(); ++i) {
      const double error = sym3::relative_error(computed[i], sample[i]);
      worst = std::isnan(error) ? 1 : std::max(worst, error);
    }
  }
  stats.low = std::log10(floor);
  stats.high = std::clamp(std::ceil(std::log10(worst)), stats.low + fewest_decades, 0.0);
}

}  // namespace

ErrorMap error_map(std::span<const sym3::Sym3<double>> matrices, sym3::Method method,
                   base::Progress* progress) {
  ErrorMap map;
  map.log10.resize(matrices.size());
  std::vector<double> errors(matrices.size());
  std::vector<sym3::Sym3<double>> computed(portion);
  for (std::size_t begin = 0; begin < matrices.size(); begin += portion) {
    if (progress) progress->report(static_cast<double>(begin) / static_cast<double>(matrices.size()));
    const auto part = matrices.subspan(begin, std::min(portion, matrices.size() - begin));
    sym3::exp<double>(part, std::span(computed).first(part.size()), method);
    for (std::size_t i = 0; i < part.size(); ++i) {
      const double error = sym3::relative_error(computed[i], part[i]);
      errors[begin + i] = error;
      map.log10[begin + i] =
          std::isnan(error) ? 0.0F : static_cast<float>(std::log10(std::max(error, 1e-20)));
    }
  }
  map.stats = {.vertices = errors.size(), .method = method};
  std::tie(map.stats.worst, map.stats.median) = worst_and_median(std::move(errors));
  fit_range(matrices, map.stats);
  return map;
}

}  // namespace viete::app
