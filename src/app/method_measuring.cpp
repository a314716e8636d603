#include "app/method_measuring.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/median.h"
#include "pose/deformer.h"
#include "sym3/exp.h"

namespace viete::app {

namespace {

using analysis::compared_methods;
using Matrix = sym3::Sym3<double>;

constexpr std::size_t sampled_matrices = 2048;
constexpr double sample_seconds = 0.3;     // shortest interval between samples; a sample takes a millisecond
constexpr double pose_rest_seconds = 0.5;  // after this time without motion, all methods are timed

bool is_in_motion(const workspace::Workspace& w) {
  return w.view.interaction.drag || w.playback.playing || w.jobs.working();
}

constexpr std::size_t timed_rounds = 5, busy_rounds = 15;  // the second if the computer is busy
// A measurement computes missing weights of the staged engine only if they need at most this many bytes.
constexpr double most_weight_bytes = 256.0 * (1 << 20);

bool lacks_small_weights(const FrameInput& timed) {
  const weights::Binding& binding = *timed.bound.binding;
  return binding.weights.empty() &&
         pose::engine_for(timed.deformer, sym3::Method::diag) == pose::EngineKind::staged &&
         8.0 * static_cast<double>(binding.vertices) * static_cast<double>(binding.handles) <=
             most_weight_bytes;
}

using TimedFrames = std::array<std::vector<workspace::FrameTimes>, workspace::MethodTimes::fused + 1>;

// Stores the medians. Returns true if the computer was busy.
bool take_medians(const TimedFrames& frames, workspace::MethodTimes& times) {
  times.busy = false;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].empty()) continue;
    const workspace::FrameTimes median = workspace::median_of(frames[i]);
    times.stages[i] = median.stages;
    times.busy |= median.busy;
  }
  return times.busy;
}

workspace::MethodSample errors_of(std::span<const Matrix> computed, std::span<const Matrix> matrices) {
  std::vector<double> errors(matrices.size());
  for (std::size_t i = 0; i < matrices.size(); ++i)
    errors[i] = sym3::relative_error(computed[i], matrices[i]);
  workspace::MethodSample sample{.worst_error = std::nan(""), .median_error = std::nan("")};
  if (std::ranges::any_of(errors, [](double e) { return std::isnan(e); })) return sample;
  sample.worst_error = std::ranges::max(errors);
  sample.median_error = base::median(std::move(errors));
  return sample;
}

}  // namespace

MethodMeasuring::Key MethodMeasuring::key_of(const workspace::Workspace& w, const LiveModel& model) {
  const document::Revisions& now = w.document.revisions();
  Key key{now.surfaces, now.cage, model.deformer() ? model.deformer()->deformer() : pose::Deformer()};
  key.deformer.amounts = {};
  return key;
}

bool MethodMeasuring::follow(workspace::Workspace& w, LiveModel& model, bool moves) {
  bool news = discard_old(w, model);
  if (!wanted_) return news;
  news |= take_samples(w, false);
  if (sampling_in(w, model) <= 0) news |= start_sampling(w, model);
  if (moves || is_in_motion(w)) {
    rests_since_ = base::wall_seconds();
    if (w.frame.method_times.busy) retry_ = {.at = rests_since_};  // the computer may be quiet afterwards
    if (timer_.running()) {
      timer_.cancel();
      timed_ = 0;
    }
  }
  news |= take_times(w, model, false);
  if (timing_in(w, model) <= 0) start_timing(w, model);
  show_drawn_times(w, model);
  return news;
}

double MethodMeasuring::due_in(const workspace::Workspace& w, const LiveModel& model) const {
  if (sampler_.has_result() || timer_.has_result()) return 0;
  return std::min(sampling_in(w, model), timing_in(w, model));
}

// If model, cage or a deformer setting other than Deformer::amounts has changed, discards all measurements.
// If only the engine has changed, discards only the sampled error.
bool MethodMeasuring::discard_old(workspace::Workspace& w, const LiveModel& model) {
  const auto engine = model.deformer() ? model.deformer()->ran() : std::nullopt;
  const Key key = key_of(w, model);
  const bool another = key_ != key;
  if (!another && engine_ == engine) return false;
  w.view.split.views[0].fused_error = 0;
  sampled_ = 0;
  if (another) {
    sampler_.cancel();
    w.frame.methods = {};
    timer_.cancel();
    w.frame.method_times = {};
    timed_ = 0;
  }
  key_ = key;
  engine_ = engine;
  return true;
}

double MethodMeasuring::sampling_in(const workspace::Workspace& w, const LiveModel& model) const {
  if (!wanted_ || !model.ran() || sampler_.running()) return base::never;
  const bool missing = model.takes_exponentials() && w.frame.methods.matrices == 0;
  return missing || sampled_ != model.frames() ? base::seconds_until(sampled_at_ + sample_seconds)
                                               : base::never;
}

bool MethodMeasuring::take_samples(workspace::Workspace& w, bool wait) {
  const auto result = sampler_.poll(wait);
  if (!result || !result->value) return false;
  w.frame.methods = *result->value;
  sampled_at_ = base::wall_seconds();
  return true;
}

// Returns true if only the error of the engine was measured, at once.
bool MethodMeasuring::start_sampling(workspace::Workspace& w, const LiveModel& model) {
  sampled_ = model.frames();
  sampled_at_ = base::wall_seconds();
  w.view.split.views[0].fused_error = model.deformer()->sampled_error();
  if (!model.takes_exponentials()) return true;
  sampler_.start([matrices = model.deformer()->sample_matrices(sampled_matrices)](base::Progress&) {
    return measure_methods(matrices);
  });
  return false;
}

double MethodMeasuring::timing_in(const workspace::Workspace& w, const LiveModel& model) const {
  const bool fused = w.document.has_cage() && engine_ == pose::EngineKind::fused;
  if (!wanted_ || !model.ran() || timer_.running() || is_in_motion(w)) return base::never;
  if (!fused && !model.takes_exponentials()) return base::never;
  const double rested = rests_since_ + pose_rest_seconds;
  return base::seconds_until(timed_ != model.frames() ? rested : std::max(rested, retry_.at));
}

void MethodMeasuring::start_timing(const workspace::Workspace& w, const LiveModel& model) {
  if (timed_ != model.frames()) retry_ = {};
  timed_ = model.frames();
  timer_.start([timed = model.input(w.document, w.document.method())](base::Progress& progress) {
    return time_methods(timed, progress);
  });
}

bool MethodMeasuring::take_times(workspace::Workspace& w, LiveModel& model, bool wait) {
  const auto result = timer_.poll(wait);
  if (!result || !result->value) return false;  // after an error, no times are shown
  w.frame.method_times = result->value->times;
  retry_ = retry_.after(w.frame.method_times.busy, base::wall_seconds());
  model.share(result->value->binding);
  return true;
}

// Until all methods are timed in this pose, shows the times of the current method's frames.
void MethodMeasuring::show_drawn_times(workspace::Workspace& w, const LiveModel& model) const {
  const auto frame = w.view.split.views[0].stats.deforming_median();
  // Without an engine, the frame is of another cage or of other weights.
  if (!frame || !engine_ || (w.frame.method_times.measured && timed_ == model.frames())) return;
  const auto found = std::ranges::find(compared_methods, frame->method);
  auto running = static_cast<std::size_t>(found - compared_methods.begin());
  if (engine_ == pose::EngineKind::fused) running = workspace::MethodTimes::fused;
  w.frame.method_times.stages[running] = frame->stages;
  w.frame.method_times.busy = frame->busy;
}

void MethodMeasuring::finish(workspace::Workspace& w, LiveModel& model) {
  if (!wanted_ || !model.takes_exponentials()) return;
  take_samples(w, true);
  if (sampled_ != model.frames()) {
    start_sampling(w, model);
    take_samples(w, true);
  }
  if (timed_ != model.frames()) start_timing(w, model);
  take_times(w, model, true);
  follow(w, model, false);
}

MethodTimings time_methods(FrameInput timed, base::Progress& progress) {
  const bool compares = timed.deformer.exponential();  // otherwise all methods have the same time
  if (compares && lacks_small_weights(timed))
    timed.bound = app::bind(timed.bound, timed.deformer, sym3::Method::diag, timed.bound, progress);
  base::WorkerPool pool;
  const Bound& bound = timed.bound;
  deform::FrameDeformer deformer(bound.cage, bound.binding, timed.deformer, pool,
                                 bound.stitches(timed.deformer) ? bound.stitching : nullptr);
  deformer.set_splats(bound.splats);
  deformer.set_mask(timed.mask);
  deformer.set_probes(timed.probes);
  deformer.set_shape(timed.shape);
  MethodTimings result{{.measured = true}, bound.binding};
  TimedFrames frames;
  std::size_t rounds = timed_rounds;
  for (std::size_t round = 0; round <= rounds; ++round) {  // round 0 fills the caches
    for (std::size_t i = 0; i < frames.size(); ++i) {
      progress.report(0);
      const bool fused = i == workspace::MethodTimes::fused;
      if (!fused && !compares) continue;
      const sym3::Method method = fused ? sym3::Method::fast : compared_methods[i];
      deformer.set_all_staged(!fused);
      const auto engine = deformer.engine(method);
      if (!engine || fused != (engine == pose::EngineKind::fused)) continue;
      const auto cost = pool.cost();
      deformer.deform(timed.pose, method);
      if (round > 0) frames[i].push_back({.stages = deformer.times(), .cost = pool.cost() - cost});
      if (fused && round == 0) result.times.fused_error = deformer.sampled_error();
    }
    if (round == timed_rounds && take_medians(frames, result.times)) rounds = busy_rounds;
  }
  take_medians(frames, result.times);
  return result;
}

workspace::MethodStats measure_methods(std::span<const Matrix> matrices) {
  workspace::MethodStats stats;
  if (matrices.empty()) return stats;
  std::vector<Matrix> out(matrices.size());
  std::array<std::vector<double>, compared_methods.size()> seconds;
  for (std::size_t round = 0; round < timed_rounds; ++round)
    for (std::size_t m = 0; m < seconds.size(); ++m) {
      const double start = base::thread_seconds();
      sym3::exp<double>(matrices, out, compared_methods[m]);
      seconds[m].push_back(base::thread_seconds() - start);
      if (round == 0) stats.samples[m] = errors_of(out, matrices);
    }
  for (std::size_t m = 0; m < seconds.size(); ++m)
    stats.samples[m].ns_per_matrix = 1e9 * base::median(seconds[m]) / static_cast<double>(matrices.size());
  stats.matrices = matrices.size();
  return stats;
}

}  // namespace viete::app
