#include "app/analysis.h"

#include <algorithm>
#include <utility>

#include "app/aside.h"
#include "base/clock.h"

namespace viete::app {

namespace {

constexpr std::size_t benchmark_count = 1 << 18;  // some seconds, and more than caches hold
constexpr std::size_t probed_matrices = 2048;
constexpr double probe_seconds = 0.3;  // between two: each takes the frame a millisecond

scene::Benchmark shown_benchmark(const bench::ExpBench& bench) {
  scene::Benchmark shown;
  shown.count = bench.count;
  for (const bench::ExpBar& bar : bench::bars_of(bench)) shown.bars.push_back({bar.name, bar.ns, bar.ours});
  return shown;
}

}  // namespace

void Analysis::follow_document(scene::Workspace& workspace) {
  shows_news_ = false;
  const scene::Document& document = workspace.document;
  if (std::exchange(workspace.requests.run_benchmark, false))
    bench_.start(
        [](base::Progress& progress) { return bench::measure_exp(benchmark_count, false, progress); });
  if (std::exchange(workspace.requests.show_report, false))
    report_.start([program = program_, state = state_](base::Progress& progress) {
      return show_report_aside(program, state, progress);
    });
  if (std::exchange(workspace.requests.stop_benchmark, false)) bench_.cancel(), report_.cancel();
  follow_benchmark(workspace);
  if (checked_model_ != document.model.surface || checked_cage_ != document.cage_file.surface)
    start_checks(document);
  take_checks(workspace, false);
}

void Analysis::follow_frame(scene::Workspace& workspace, const LiveModel& model) {
  shows_news_ = false;
  follow_path(workspace, model);
  if (probe_wanted_) follow_probe(workspace, model);
}

bool Analysis::has_news(const scene::Workspace& workspace, const LiveModel& model) const {
  return probe_.has_result() || probe_is_due(workspace, model) || checks_.has_result() ||
         bench_.has_result() || report_.has_result();
}

// What was measured of another path says nothing of this one. How far cage parts turn is no matter of the
// path.
void Analysis::follow_path(scene::Workspace& workspace, const LiveModel& model) {
  const scene::Revisions& now = workspace.document.revisions();
  const deform::Deformer* deformer = model.deformer();
  const auto engine = deformer ? deformer->ran() : std::nullopt;
  Path path{now.surfaces, now.cage, deformer ? deformer->scheme() : deform::Scheme()};
  path.scheme.amounts = {};
  const bool another = path_ != path;
  if (!another && engine_ == engine) return;
  workspace.fused_error = 0;
  probed_ = 0;
  if (another) {
    probe_.forget();
    workspace.methods = {};
  }
  path_ = path;
  engine_ = engine;
  shows_news_ = true;
}

void Analysis::follow_benchmark(scene::Workspace& workspace) {
  scene::Benchmark& shown = workspace.benchmark;
  if (const auto result = bench_.poll()) {
    if (result->value) shown = shown_benchmark(*result->value);
    if (!result->problem.empty()) workspace.messages.error("The benchmark failed: " + result->problem);
    shows_news_ = true;
  }
  if (const auto result = report_.poll()) {
    if (result->value) workspace.messages.info(*result->value);
    if (!result->problem.empty()) workspace.messages.error("There is no report: " + result->problem);
    shows_news_ = true;
  }
  shown.running = bench_.running() || report_.running();
  shown.done = std::max(bench_.done(), report_.done());
}

// Of the surfaces as they were read: poses do not matter, nor what they are bound by.
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
  workspace.checks.done = checks_.done();
  if (!result) return;
  shows_news_ = true;
  if (!result->value) return workspace.messages.error("The checks came to no end: " + result->problem);
  scene::take_findings(workspace.checks, *std::move(result->value));
}

void Analysis::finish_checks(scene::Workspace& workspace) {
  follow_document(workspace);
  if (checks_.running()) take_checks(workspace, true);
}

bool Analysis::probe_is_due(const scene::Workspace& workspace, const LiveModel& model) const {
  if (!probe_wanted_ || !model.deformer() || !model.deformer()->ran()) return false;
  const bool missing = model.takes_exponentials() && workspace.methods.matrices == 0;
  const bool fresh = missing || probed_ != model.frames();
  return fresh && probe_.ready() && base::wall_seconds() - probed_at_ > probe_seconds;
}

void Analysis::follow_probe(scene::Workspace& workspace, const LiveModel& model) {
  if (auto stats = probe_.poll()) {
    workspace.methods = *stats;
    shows_news_ = true;
  }
  if (!probe_is_due(workspace, model)) return;
  probed_ = model.frames();
  probed_at_ = base::wall_seconds();
  workspace.fused_error = model.deformer()->sampled_error();
  if (model.takes_exponentials()) probe_.offer(model.deformer()->sample_matrices(probed_matrices));
  shows_news_ |= !model.takes_exponentials();
}

}  // namespace viete::app
