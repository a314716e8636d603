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

void Analysis::follow_document(scene::Workspace& workspace) {
  shows_news_ = false;
  const scene::Document& document = workspace.document;
  if (std::exchange(workspace.requests.show_report, false))
    report_.start([program = program_, state = state_](base::Progress& progress) {
      return create_and_show_report(program, state, progress);
    });
  if (std::exchange(workspace.requests.stop_report, false)) report_.cancel();
  follow_report(workspace);
  if (checked_model_ != document.model.surface || checked_cage_ != document.cage_file.surface)
    start_checks(document);
  take_checks(workspace, false);
}

void Analysis::follow_frame(scene::Workspace& workspace, LiveModel& model, bool moves) {
  shows_news_ = false;
  follow_path(workspace, model);
  if (!probe_wanted_) return;
  take_probe(workspace, false);
  if (probe_is_due(workspace, model)) start_probe(workspace, model);
  follow_times(workspace, model, moves);
}

bool Analysis::has_news(const scene::Workspace& workspace, const LiveModel& model) const {
  return probe_.has_result() || probe_is_due(workspace, model) || checks_.has_result() ||
         report_.has_result() || timer_.has_result() || timer_is_due(workspace, model);
}

// Discards measurements of another path. The turns of cage parts do not belong to the path.
void Analysis::follow_path(scene::Workspace& workspace, const LiveModel& model) {
  const scene::Revisions& now = workspace.document.revisions();
  const deform::Deformer* deformer = model.deformer();
  const auto engine = deformer ? deformer->ran() : std::nullopt;
  Path path{now.surfaces, now.cage, deformer ? deformer->scheme() : deform::Scheme()};
  path.scheme.amounts = {};
  const bool another = path_ != path;
  if (!another && engine_ == engine) return;
  workspace.split.views[0].fused_error = 0;
  probed_ = 0;
  if (another) {
    probe_.cancel();
    workspace.methods = {};
    timer_.cancel();
    workspace.method_times = {};
    timed_ = 0;
  }
  path_ = path;
  engine_ = engine;
  shows_news_ = true;
}

void Analysis::follow_report(scene::Workspace& workspace) {
  if (const auto result = report_.poll()) {
    if (result->value) workspace.messages.succeeded("report"), workspace.messages.info(*result->value);
    if (!result->problem.empty()) workspace.messages.error("Report failed: " + result->problem, {"report"});
    shows_news_ = true;
  }
  workspace.reporting = report_.state();
}

// Checks the surfaces as loaded, independent of pose and binding.
void Analysis::start_checks(const scene::Document& document) {
  checked_model_ = document.model.surface;
  checked_cage_ = document.cage_file.surface;
  checks_.start([model = document.model, cage = document.cage_file](base::Progress& progress) {
    return scene::check(model, cage, &progress);
  });
}

void Analysis::take_checks(scene::Workspace& workspace, bool wait) {
  auto result = checks_.poll(wait);
  workspace.checks.running = checks_.running();
  workspace.checks.done = checks_.state().done;
  if (!result) return;
  shows_news_ = true;
  if (!result->value)
    return workspace.messages.error("Checks failed: " + result->problem, {"checks", scene::Scope::cage});
  workspace.messages.succeeded("checks");
  scene::take_findings(workspace.checks, *std::move(result->value));
}

void Analysis::finish_checks(scene::Workspace& workspace) {
  follow_document(workspace);
  if (checks_.running()) take_checks(workspace, true);
}

bool Analysis::probe_is_due(const scene::Workspace& workspace, const LiveModel& model) const {
  if (!probe_wanted_ || !model.ran()) return false;
  const bool missing = model.takes_exponentials() && workspace.methods.matrices == 0;
  const bool fresh = missing || probed_ != model.frames();
  return fresh && !probe_.running() && base::wall_seconds() - probed_at_ > probe_seconds;
}

void Analysis::take_probe(scene::Workspace& workspace, bool wait) {
  const auto result = probe_.poll(wait);
  if (!result || !result->value) return;
  workspace.methods = *result->value;
  probed_at_ = base::wall_seconds();
  shows_news_ = true;
}

void Analysis::start_probe(scene::Workspace& workspace, const LiveModel& model) {
  probed_ = model.frames();
  probed_at_ = base::wall_seconds();
  workspace.split.views[0].fused_error = model.deformer()->sampled_error();
  if (model.takes_exponentials())
    probe_.start([matrices = model.deformer()->sample_matrices(probed_matrices)](base::Progress&) {
      return measure_methods(matrices);
    });
  shows_news_ |= !model.takes_exponentials();
}

bool Analysis::timer_is_due(const scene::Workspace& workspace, const LiveModel& model) const {
  return probe_wanted_ && timed_ != model.frames() && model.takes_exponentials() && !timer_.running() &&
         !is_in_motion(workspace) && base::wall_seconds() - rests_since_ > pose_rest_seconds;
}

void Analysis::start_timer(const scene::Workspace& workspace, const LiveModel& model) {
  timed_ = model.frames();
  timer_.start([timed = model.input(workspace.document, workspace.document.method)](
                   base::Progress& progress) { return time_methods(timed, progress); });
}

void Analysis::take_times(scene::Workspace& workspace, LiveModel& model, bool wait) {
  const auto result = timer_.poll(wait);
  if (!result || !result->value) return;  // a failed measurement shows no bar
  workspace.method_times = result->value->times;
  model.share(result->value->binding);
  shows_news_ = true;
}

// During motion the running method's bar shows its frames; at rest all methods are measured.
void Analysis::follow_times(scene::Workspace& workspace, LiveModel& model, bool moves) {
  if (moves || is_in_motion(workspace)) {
    rests_since_ = base::wall_seconds();
    if (timer_.running()) timer_.cancel(), timed_ = 0;
  }
  take_times(workspace, model, false);
  if (timer_is_due(workspace, model)) start_timer(workspace, model);
  const auto frame = workspace.split.views[0].stats.deforming_median();
  if (!frame || (workspace.method_times.measured && timed_ == model.frames())) return;
  const auto& methods = scene::compared_methods;
  const auto running = std::ranges::find(methods, frame->method);
  if (running != methods.end())
    workspace.method_times.links[static_cast<std::size_t>(running - methods.begin())] = frame->links;
}

void Analysis::finish_measuring(scene::Workspace& workspace, LiveModel& model) {
  if (!probe_wanted_ || !model.takes_exponentials()) return;
  take_probe(workspace, true);
  if (probed_ != model.frames()) start_probe(workspace, model), take_probe(workspace, true);
  if (timed_ != model.frames()) start_timer(workspace, model);
  take_times(workspace, model, true);
  follow_times(workspace, model, false);
}

}  // namespace viete::app
