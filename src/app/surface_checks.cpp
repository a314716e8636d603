#include "app/surface_checks.h"

#include "base/memory.h"

namespace viete::app {

bool SurfaceChecks::follow(workspace::Workspace& w) {
  if (const Surfaces now = surfaces_of(w); checked_ != now) {
    checked_ = now;
    job_.start([model = w.document.model(), cage = w.document.cage_file()](base::Progress& progress) {
      auto findings = document::check(model, cage, &progress);
      base::release_freed_memory();
      return findings;
    });
  }
  return take(w, false);
}

bool SurfaceChecks::take(workspace::Workspace& w, bool wait) {
  auto result = job_.poll(wait);
  w.checks.running = job_.running();
  w.checks.done = job_.state().done;
  if (!result) return false;
  if (result->value) {
    w.messages.succeeded("checks");
    workspace::take_findings(w.checks, *std::move(result->value));
    follow_outside(w);
  } else {
    w.messages.error("Checks failed: " + result->problem, {"checks", workspace::Scope::cage});
  }
  return true;
}

// Offers to enclose the model if a change of the cage has pushed vertices of the same model out.
void SurfaceChecks::follow_outside(workspace::Workspace& w) {
  const auto found = workspace::outside_finding(w.checks);
  const std::size_t outside = found ? w.checks.findings[*found].size() : 0;
  const bool edited =
      std::exchange(outside_of_, checked_.model) == checked_.model && w.document.history().can_undo();
  w.checks.pushed_out = edited && (outside > w.checks.outside || (w.checks.pushed_out && outside > 0));
  if (outside > w.checks.outside) w.panels.offer_cage = true;
  w.checks.outside = outside;
}

void SurfaceChecks::finish(workspace::Workspace& w) {
  follow(w);
  if (job_.running()) take(w, true);
}

}  // namespace viete::app
