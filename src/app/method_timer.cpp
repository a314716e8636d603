// Times and errors of every method, for whole frames and for a sample of the frame's matrices.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "app/analysis.h"
#include "base/clock.h"
#include "base/median.h"
#include "base/worker_pool.h"
#include "deform/scheme.h"
#include "sym3/exp.h"
#include "sym3/reference.h"

namespace viete::app {

namespace {

using scene::compared_methods;

constexpr std::size_t timed_rounds = 5;
// Larger staged weights are computed only when a method that needs them is chosen.
constexpr double most_weight_bytes = 256.0 * (1 << 20);

bool lacks_small_weights(const FrameInput& timed) {
  const deform::Binding& binding = *timed.bound.binding;
  return binding.weights.empty() &&
         deform::engine_for(timed.scheme, sym3::Method::diag) == deform::EngineKind::staged &&
         8.0 * static_cast<double>(binding.vertices) * static_cast<double>(binding.handles) <=
             most_weight_bytes;
}

}  // namespace

MethodTimings time_methods(FrameInput timed, base::Progress& progress) {
  if (lacks_small_weights(timed))
    timed.bound = app::bind(timed.bound.model, timed.bound.cage, timed.scheme, sym3::Method::diag,
                            timed.bound, progress);
  base::WorkerPool pool;
  const Bound& bound = timed.bound;
  deform::Deformer deformer(bound.cage, bound.binding, timed.scheme, pool,
                            bound.stitches(timed.scheme) ? bound.stitching : nullptr);
  deformer.set_all_staged(timed.all_staged);
  deformer.set_mask(timed.mask);
  deformer.set_probes(timed.probes);
  deformer.set_shape(timed.shape);
  std::array<std::vector<scene::FrameTimes>, compared_methods.size()> frames;
  for (std::size_t round = 0; round <= timed_rounds; ++round) {  // the first round fills caches
    for (std::size_t m = 0; m < frames.size(); ++m) {
      progress.report(0);
      if (!deformer.engine(compared_methods[m])) continue;
      deformer.deform(timed.pose, compared_methods[m]);
      if (round > 0) frames[m].push_back({.links = deformer.times()});
    }
  }
  MethodTimings result{{.links = {}, .measured = true}, bound.binding};
  for (std::size_t m = 0; m < frames.size(); ++m)
    if (!frames[m].empty()) result.times.links[m] = scene::median_of(frames[m]).links;
  return result;
}

namespace {

constexpr int rounds = 5;
constexpr std::size_t method_count = scene::compared_methods.size();
using Matrix = sym3::Sym3<double>;

scene::MethodSample errors_of(std::span<const Matrix> computed, std::span<const Matrix> matrices) {
  std::vector<double> errors(matrices.size());
  for (std::size_t i = 0; i < matrices.size(); ++i)
    errors[i] = sym3::relative_error(computed[i], matrices[i]);
  scene::MethodSample sample{.worst_error = std::nan(""), .median_error = std::nan("")};
  if (std::ranges::any_of(errors, [](double e) { return std::isnan(e); })) return sample;
  sample.worst_error = std::ranges::max(errors);
  sample.median_error = base::median(std::move(errors));
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
    stats.samples[m].ns_per_matrix = 1e9 * base::median(seconds[m]) / static_cast<double>(matrices.size());
  }
  stats.matrices = matrices.size();
  return stats;
}

}  // namespace viete::app
