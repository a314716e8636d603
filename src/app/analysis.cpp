#include "app/analysis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "app/child_process.h"
#include "base/clock.h"
#include "base/median.h"
#include "base/memory.h"
#include "base/worker_pool.h"
#include "deform/scheme.h"
#include "deform/vertex_sample.h"
#include "sym3/eigenvalues.h"
#include "sym3/exp.h"
#include "sym3/reference.h"
#include "sym3/rotation.h"
#include "sym3/route.h"

namespace viete::app {

namespace {

constexpr std::size_t probed_matrices = 2048;
constexpr double probe_seconds = 0.3;      // shortest interval between samples; a sample takes a millisecond
constexpr double pose_rest_seconds = 0.5;  // after this time without motion, all methods are timed

bool is_in_motion(const workspace::Workspace& w) {
  return w.view.interaction.drag || w.playback.playing || w.jobs.working();
}

}  // namespace

void Analysis::follow_document(workspace::Workspace& w) {
  shows_news_ = false;
  const document::Document& document = w.document;
  if (std::exchange(w.jobs.requests.show_report, false))
    report_.start([program = program_, state = state_](base::Progress& progress) {
      return create_and_show_report(program, state, progress);
    });
  if (std::exchange(w.jobs.requests.stop_report, false)) report_.cancel();
  follow_report(w);
  if (checked_model_ != document.model.surface || checked_cage_ != document.cage_file.surface)
    start_checks(document);
  take_checks(w, false);
}

void Analysis::follow_frame(workspace::Workspace& w, LiveModel& model, bool moves) {
  shows_news_ = false;
  follow_path(w, model);
  if (!probe_wanted_) return;
  take_probe(w, false);
  if (probe_is_due(w, model)) start_probe(w, model);
  follow_times(w, model, moves);
}

bool Analysis::has_news(const workspace::Workspace& w, const LiveModel& model) const {
  return probe_.has_result() || probe_is_due(w, model) || checks_.has_result() || report_.has_result() ||
         timer_.has_result() || timer_is_due(w, model);
}

// If model, cage or a deformer setting other than Scheme::amounts has changed, discards all measurements. If
// only the engine has changed, discards only the sampled error.
void Analysis::follow_path(workspace::Workspace& w, const LiveModel& model) {
  const document::Revisions& now = w.document.revisions();
  const deform::Deformer* deformer = model.deformer();
  const auto engine = deformer ? deformer->ran() : std::nullopt;
  Path path{now.surfaces, now.cage, deformer ? deformer->scheme() : deform::Scheme()};
  path.scheme.amounts = {};
  const bool another = path_ != path;
  if (!another && engine_ == engine) return;
  w.view.split.views[0].fused_error = 0;
  probed_ = 0;
  if (another) {
    probe_.cancel();
    w.frame.methods = {};
    timer_.cancel();
    w.frame.method_times = {};
    timed_ = 0;
  }
  path_ = path;
  engine_ = engine;
  shows_news_ = true;
}

void Analysis::follow_report(workspace::Workspace& w) {
  if (const auto result = report_.poll()) {
    if (result->value) w.messages.succeeded("report"), w.messages.info(*result->value);
    if (!result->problem.empty()) w.messages.error("Report failed: " + result->problem, {"report"});
    shows_news_ = true;
  }
  w.jobs.reporting = report_.state();
}

void Analysis::start_checks(const document::Document& document) {
  checked_model_ = document.model.surface;
  checked_cage_ = document.cage_file.surface;
  checks_.start([model = document.model, cage = document.cage_file](base::Progress& progress) {
    auto findings = document::check(model, cage, &progress);
    base::release_freed_memory();
    return findings;
  });
}

void Analysis::take_checks(workspace::Workspace& w, bool wait) {
  auto result = checks_.poll(wait);
  w.checks.running = checks_.running();
  w.checks.done = checks_.state().done;
  if (!result) return;
  shows_news_ = true;
  if (!result->value)
    return w.messages.error("Checks failed: " + result->problem, {"checks", workspace::Scope::cage});
  w.messages.succeeded("checks");
  workspace::take_findings(w.checks, *std::move(result->value));
  follow_outside(w);
}

// Offers to enclose the model if a change of the cage has pushed vertices of the same model out.
void Analysis::follow_outside(workspace::Workspace& w) {
  const auto found = workspace::outside_finding(w.checks);
  const std::size_t outside = found ? w.checks.findings[*found].size() : 0;
  const bool edited =
      std::exchange(outside_of_, checked_model_) == checked_model_ && w.document.history.can_undo();
  w.checks.pushed_out = edited && (outside > w.checks.outside || (w.checks.pushed_out && outside > 0));
  if (outside > w.checks.outside) w.panels.offer_cage = true;
  w.checks.outside = outside;
}

void Analysis::finish_checks(workspace::Workspace& w) {
  follow_document(w);
  if (checks_.running()) take_checks(w, true);
}

bool Analysis::probe_is_due(const workspace::Workspace& w, const LiveModel& model) const {
  if (!probe_wanted_ || !model.ran()) return false;
  const bool missing = model.takes_exponentials() && w.frame.methods.matrices == 0;
  const bool fresh = missing || probed_ != model.frames();
  return fresh && !probe_.running() && base::wall_seconds() - probed_at_ > probe_seconds;
}

void Analysis::take_probe(workspace::Workspace& w, bool wait) {
  const auto result = probe_.poll(wait);
  if (!result || !result->value) return;
  w.frame.methods = *result->value;
  probed_at_ = base::wall_seconds();
  shows_news_ = true;
}

void Analysis::start_probe(workspace::Workspace& w, const LiveModel& model) {
  probed_ = model.frames();
  probed_at_ = base::wall_seconds();
  w.view.split.views[0].fused_error = model.deformer()->sampled_error();
  if (model.takes_exponentials())
    probe_.start([matrices = model.deformer()->sample_matrices(probed_matrices)](base::Progress&) {
      return measure_methods(matrices);
    });
  shows_news_ |= !model.takes_exponentials();
}

bool Analysis::timer_is_due(const workspace::Workspace& w, const LiveModel& model) const {
  const double now = base::wall_seconds();
  return probe_wanted_ && (timed_ != model.frames() || now > retry_.at) && model.takes_exponentials() &&
         !timer_.running() && !is_in_motion(w) && now - rests_since_ > pose_rest_seconds;
}

void Analysis::start_timer(const workspace::Workspace& w, const LiveModel& model) {
  if (std::exchange(timed_, model.frames()) != timed_) retry_ = {};
  timer_.start([timed = model.input(w.document, w.document.method)](base::Progress& progress) {
    return time_methods(timed, progress);
  });
}

void Analysis::take_times(workspace::Workspace& w, LiveModel& model, bool wait) {
  const auto result = timer_.poll(wait);
  if (!result || !result->value) return;  // after an error, no times are shown
  w.frame.method_times = result->value->times;
  retry_ = retry_.after(w.frame.method_times.busy, base::wall_seconds());
  model.share(result->value->binding);
  shows_news_ = true;
}

// During motion, shows the times of the current method's frames. At rest, measures all methods.
void Analysis::follow_times(workspace::Workspace& w, LiveModel& model, bool moves) {
  if (moves || is_in_motion(w)) {
    rests_since_ = base::wall_seconds();
    if (timer_.running()) timer_.cancel(), timed_ = 0;
  }
  take_times(w, model, false);
  if (timer_is_due(w, model)) start_timer(w, model);
  const auto frame = w.view.split.views[0].stats.deforming_median();
  if (!frame || (w.frame.method_times.measured && timed_ == model.frames())) return;
  const auto& methods = analysis::compared_methods;
  auto running = static_cast<std::size_t>(std::ranges::find(methods, frame->method) - methods.begin());
  if (engine_ == deform::EngineKind::fused) running = workspace::MethodTimes::fused;
  w.frame.method_times.links[running] = frame->links;
  w.frame.method_times.busy = frame->busy;
}

void Analysis::finish_measuring(workspace::Workspace& w, LiveModel& model) {
  if (!probe_wanted_ || !model.takes_exponentials()) return;
  take_probe(w, true);
  if (probed_ != model.frames()) start_probe(w, model), take_probe(w, true);
  if (timed_ != model.frames()) start_timer(w, model);
  take_times(w, model, true);
  follow_times(w, model, false);
}

namespace {

using analysis::compared_methods;

constexpr std::size_t timed_rounds = 5, busy_rounds = 15;  // the second if the computer is busy
// A measurement computes missing weights of the staged engine only if they need at most this many bytes.
constexpr double most_weight_bytes = 256.0 * (1 << 20);

bool lacks_small_weights(const FrameInput& timed) {
  const deform::Binding& binding = *timed.bound.binding;
  return binding.weights.empty() &&
         deform::engine_for(timed.scheme, sym3::Method::diag) == deform::EngineKind::staged &&
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
    times.links[i] = median.links;
    times.busy |= median.busy;
  }
  return times.busy;
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
      const sym3::Method method = fused ? sym3::Method::fast : compared_methods[i];
      deformer.set_all_staged(!fused);
      const auto engine = deformer.engine(method);
      if (!engine || fused != (engine == deform::EngineKind::fused)) continue;
      const auto cost = pool.cost();
      deformer.deform(timed.pose, method);
      if (round > 0) frames[i].push_back({.links = deformer.times(), .cost = pool.cost() - cost});
      if (fused && round == 0) result.times.fused_error = deformer.sampled_error();
    }
    if (round == timed_rounds && take_medians(frames, result.times)) rounds = busy_rounds;
  }
  take_medians(frames, result.times);
  return result;
}

namespace {

constexpr int rounds = 5;
constexpr std::size_t method_count = analysis::compared_methods.size();
using Matrix = sym3::Sym3<double>;

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

workspace::MethodStats measure_methods(std::span<const Matrix> matrices) {
  workspace::MethodStats stats;
  if (matrices.empty()) return stats;
  std::vector<Matrix> out(matrices.size());
  std::array<std::vector<double>, method_count> seconds;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t m = 0; m < method_count; ++m) {
      const double start = base::thread_seconds();
      sym3::exp<double>(matrices, out, analysis::compared_methods[m]);
      seconds[m].push_back(base::thread_seconds() - start);
      if (round == 0) stats.samples[m] = errors_of(out, matrices);
    }
  }
  for (std::size_t m = 0; m < method_count; ++m)
    stats.samples[m].ns_per_matrix = 1e9 * base::median(seconds[m]) / static_cast<double>(matrices.size());
  stats.matrices = matrices.size();
  return stats;
}

namespace {

using sym3::Method;

// GLM matrices are column-major.
glm::dmat3 map_of(const sym3::Sym3<double>& stretch, const mesh::Vec3& turn) {
  const auto r = sym3::exp_rotation<double>({turn[0], turn[1], turn[2]});
  const auto s = sym3::exp(stretch);
  const glm::dmat3 rotation(r[0], r[3], r[6], r[1], r[4], r[7], r[2], r[5], r[8]);
  return rotation * glm::dmat3(s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz);
}

std::string words_of(Method method, const sym3::Route& route) {
  if (method == Method::diag) return "eigenvectors by QR";
  if (method == Method::fast) {
    if (route.by_jacobi) return "Jacobi's method";
    const std::string degree = "degree " + std::to_string(route.degree);
    if (route.squarings == 0) return degree + ", without squaring";
    return degree + ", squared " + std::to_string(route.squarings) +
           (route.squarings == 1 ? " time" : " times");
  }
  constexpr const char* cases[] = {"", "case 1: all equal", "case 2: two equal", "case 3: all different"};
  return std::string(method == Method::sd ? "QR, " : "Viete, ") + cases[route.distinct];
}

std::vector<workspace::VertexView::Way> ways_of(const sym3::Sym3<double>& sum) {
  std::vector<workspace::VertexView::Way> ways;
  for (const Method method : analysis::compared_methods)
    ways.push_back({method, words_of(method, sym3::route(sum, method)),
                    sym3::relative_error(sym3::exp(sum, method), sum)});
  return ways;
}

workspace::VertexView view_of(std::uint32_t vertex, const deform::VertexSum& sum) {
  workspace::VertexView view;
  view.vertex = vertex;
  view.has_logs = sum.has_logs;
  sym3::Sym3<double> partial{};
  for (const auto& term : sum.terms) {
    const double w = term.weight;
    const auto& x = term.stretch;
    partial = {partial.xx + w * x.xx, partial.xy + w * x.xy, partial.xz + w * x.xz,
               partial.yy + w * x.yy, partial.yz + w * x.yz, partial.zz + w * x.zz};
    view.terms.push_back({term.handle, w, term.at, sym3::eigenvalues(partial)});
  }
  if (!sum.has_logs) return view;
  view.map = map_of(sum.stretch, sum.turn);
  view.degrees = mesh::norm(sum.turn) * 180 / std::numbers::pi;
  view.ways = ways_of(sum.stretch);
  return view;
}

}  // namespace

bool Analysis::vertex_is_due(const workspace::Workspace& w, const LiveModel& model) const {
  return (w.view.vertex.vertex || inspected_.vertex) &&
         inspected_ != Inspected{w.view.vertex.vertex, model.frames(), model.deformer()};
}

bool Analysis::follow_vertex(workspace::Workspace& w, const LiveModel& model) {
  if (!vertex_is_due(w, model)) return false;
  inspected_ = {w.view.vertex.vertex, model.frames(), model.deformer()};
  const auto vertex = w.view.vertex.vertex;
  w.view.vertex = {};
  const deform::Deformer* deformer = model.deformer();
  const mesh::Surface& surface = *w.document.model.surface;
  if (!vertex || *vertex >= surface.positions.size()) return true;
  w.view.vertex.vertex = vertex;
  if (!model.ran() || !w.document.has_cage()) return true;
  const Bound& bound = model.bound();
  const deform::Weigher weigher(*bound.cage, bound.binding->weighting);
  const deform::VertexSum sum =
      deform::vertex_sum(weigher, *bound.binding, deformer->mask(), deformer->state().rows(), *vertex);
  w.view.vertex = view_of(*vertex, sum);
  return true;
}

}  // namespace viete::app
