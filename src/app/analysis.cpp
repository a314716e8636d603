#include "app/analysis.h"

#include <algorithm>

#include "app/child_process.h"
#include "base/clock.h"

namespace viete::app {

namespace {

constexpr std::size_t probed_matrices = 2048;
constexpr double probe_seconds = 0.3;      // minimum interval: each sample costs the frame a millisecond
constexpr double pose_rest_seconds = 0.5;  // without a new frame, until the pose counts as at rest

bool is_in_motion(const scene::Workspace& w) {
  return w.interaction.drag || w.playback.playing || w.making_cage.running || w.loading.running ||
         w.binding.running;
}

}  // namespace

void Analysis::follow_document(scene::Workspace& w) {
  shows_news_ = false;
  const scene::Document& document = w.document;
  if (std::exchange(w.requests.show_report, false))
    report_.start([program = program_, state = state_](base::Progress& progress) {
      return create_and_show_report(program, state, progress);
    });
  if (std::exchange(w.requests.stop_report, false)) report_.cancel();
  follow_report(w);
  if (checked_model_ != document.model.surface || checked_cage_ != document.cage_file.surface)
    start_checks(document);
  take_checks(w, false);
}

void Analysis::follow_frame(scene::Workspace& w, LiveModel& model, bool moves) {
  shows_news_ = false;
  follow_path(w, model);
  if (!probe_wanted_) return;
  take_probe(w, false);
  if (probe_is_due(w, model)) start_probe(w, model);
  follow_times(w, model, moves);
}

bool Analysis::has_news(const scene::Workspace& w, const LiveModel& model) const {
  return probe_.has_result() || probe_is_due(w, model) || checks_.has_result() || report_.has_result() ||
         timer_.has_result() || timer_is_due(w, model);
}

// Discards measurements of another path. The turns of cage parts do not belong to the path.
void Analysis::follow_path(scene::Workspace& w, const LiveModel& model) {
  const scene::Revisions& now = w.document.revisions();
  const deform::Deformer* deformer = model.deformer();
  const auto engine = deformer ? deformer->ran() : std::nullopt;
  Path path{now.surfaces, now.cage, deformer ? deformer->scheme() : deform::Scheme()};
  path.scheme.amounts = {};
  const bool another = path_ != path;
  if (!another && engine_ == engine) return;
  w.split.views[0].fused_error = 0;
  probed_ = 0;
  if (another) {
    probe_.cancel();
    w.methods = {};
    timer_.cancel();
    w.method_times = {};
    timed_ = 0;
  }
  path_ = path;
  engine_ = engine;
  shows_news_ = true;
}

void Analysis::follow_report(scene::Workspace& w) {
  if (const auto result = report_.poll()) {
    if (result->value) w.messages.succeeded("report"), w.messages.info(*result->value);
    if (!result->problem.empty()) w.messages.error("Report failed: " + result->problem, {"report"});
    shows_news_ = true;
  }
  w.reporting = report_.state();
}

// Checks the surfaces as loaded, independent of pose and binding.
void Analysis::start_checks(const scene::Document& document) {
  checked_model_ = document.model.surface;
  checked_cage_ = document.cage_file.surface;
  checks_.start([model = document.model, cage = document.cage_file](base::Progress& progress) {
    return scene::check(model, cage, &progress);
  });
}

void Analysis::take_checks(scene::Workspace& w, bool wait) {
  auto result = checks_.poll(wait);
  w.checks.running = checks_.running();
  w.checks.done = checks_.state().done;
  if (!result) return;
  shows_news_ = true;
  if (!result->value)
    return w.messages.error("Checks failed: " + result->problem, {"checks", scene::Scope::cage});
  w.messages.succeeded("checks");
  scene::take_findings(w.checks, *std::move(result->value));
}

void Analysis::finish_checks(scene::Workspace& w) {
  follow_document(w);
  if (checks_.running()) take_checks(w, true);
}

bool Analysis::probe_is_due(const scene::Workspace& w, const LiveModel& model) const {
  if (!probe_wanted_ || !model.ran()) return false;
  const bool missing = model.takes_exponentials() && w.methods.matrices == 0;
  const bool fresh = missing || probed_ != model.frames();
  return fresh && !probe_.running() && base::wall_seconds() - probed_at_ > probe_seconds;
}

void Analysis::take_probe(scene::Workspace& w, bool wait) {
  const auto result = probe_.poll(wait);
  if (!result || !result->value) return;
  w.methods = *result->value;
  probed_at_ = base::wall_seconds();
  shows_news_ = true;
}

void Analysis::start_probe(scene::Workspace& w, const LiveModel& model) {
  probed_ = model.frames();
  probed_at_ = base::wall_seconds();
  w.split.views[0].fused_error = model.deformer()->sampled_error();
  if (model.takes_exponentials())
    probe_.start([matrices = model.deformer()->sample_matrices(probed_matrices)](base::Progress&) {
      return measure_methods(matrices);
    });
  shows_news_ |= !model.takes_exponentials();
}

bool Analysis::timer_is_due(const scene::Workspace& w, const LiveModel& model) const {
  return probe_wanted_ && timed_ != model.frames() && model.takes_exponentials() && !timer_.running() &&
         !is_in_motion(w) && base::wall_seconds() - rests_since_ > pose_rest_seconds;
}

void Analysis::start_timer(const scene::Workspace& w, const LiveModel& model) {
  timed_ = model.frames();
  timer_.start([timed = model.input(w.document, w.document.method)](base::Progress& progress) {
    return time_methods(timed, progress);
  });
}

void Analysis::take_times(scene::Workspace& w, LiveModel& model, bool wait) {
  const auto result = timer_.poll(wait);
  if (!result || !result->value) return;  // a failed measurement shows no bar
  w.method_times = result->value->times;
  model.share(result->value->binding);
  shows_news_ = true;
}

// During motion the running method's bar shows its frames; at rest all methods are measured.
void Analysis::follow_times(scene::Workspace& w, LiveModel& model, bool moves) {
  if (moves || is_in_motion(w)) {
    rests_since_ = base::wall_seconds();
    if (timer_.running()) timer_.cancel(), timed_ = 0;
  }
  take_times(w, model, false);
  if (timer_is_due(w, model)) start_timer(w, model);
  const auto frame = w.split.views[0].stats.deforming_median();
  if (!frame || (w.method_times.measured && timed_ == model.frames())) return;
  const auto& methods = scene::compared_methods;
  const auto running = std::ranges::find(methods, frame->method);
  if (running != methods.end())
    w.method_times.links[static_cast<std::size_t>(running - methods.begin())] = frame->links;
}

void Analysis::finish_measuring(scene::Workspace& w, LiveModel& model) {
  if (!probe_wanted_ || !model.takes_exponentials()) return;
  take_probe(w, true);
  if (probed_ != model.frames()) start_probe(w, model), take_probe(w, true);
  if (timed_ != model.frames()) start_timer(w, model);
  take_times(w, model, true);
  follow_times(w, model, false);
}

}  // namespace viete::app
