#include "app/method_timer.h"

#include <array>
#include <utility>
#include <vector>

#include "base/median.h"
#include "base/worker_pool.h"
#include "deform/scheme.h"

namespace viete::app {

namespace {

using scene::compared_methods;

constexpr std::size_t timed_rounds = 5;
// Larger weights of the staged engine are made only when a method that needs them is chosen.
constexpr double most_weight_bytes = 256.0 * (1 << 20);

bool lacks_weights(const TimedPose& timed) {
  return timed.bound.binding->weights.empty() &&
         deform::engine_for(timed.scheme, sym3::Method::diag) == deform::EngineKind::staged;
}

double weight_bytes(const deform::Binding& binding) {
  return 8.0 * static_cast<double>(binding.vertices) * static_cast<double>(binding.handles);
}

deform::LinkTimes median_of(const std::vector<deform::LinkTimes>& frames) {
  deform::LinkTimes median;
  for (std::size_t link = 0; link < deform::link_count; ++link) {
    std::vector<double> ms;
    for (const auto& frame : frames) ms.push_back(frame.ms[link]);
    median.ms[link] = base::median(std::move(ms));
  }
  return median;
}

}  // namespace

MethodTimings time_methods(TimedPose timed, base::Progress& progress) {
  if (lacks_weights(timed) && weight_bytes(*timed.bound.binding) <= most_weight_bytes)
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
  std::array<std::vector<deform::LinkTimes>, compared_methods.size()> frames;
  for (std::size_t round = 0; round <= timed_rounds; ++round) {  // the first one fills caches
    for (std::size_t m = 0; m < frames.size(); ++m) {
      progress.report(0);
      if (!deformer.engine(compared_methods[m])) continue;
      deformer.deform(timed.pose, compared_methods[m]);
      if (round > 0) frames[m].push_back(deformer.times());
    }
  }
  MethodTimings result{{.links = {}, .measured = true}, bound.binding};
  for (std::size_t m = 0; m < frames.size(); ++m)
    if (!frames[m].empty()) result.times.links[m] = median_of(frames[m]);
  return result;
}

}  // namespace viete::app
