#include "app/cage_maker.h"

#include <utility>

#include "base/clock.h"
#include "base/text.h"

namespace viete::app {

namespace {

constexpr double rest_seconds = 0.3;  // time without changes before a full-quality cage is generated

std::string text_of(const cages::Wish& wish) {
  return wish.kind == cages::Kind::box ? "Making a box"
                                       : "Making a cage of " + base::counted(wish.triangles, "triangle");
}

}  // namespace

CageMaker::Made CageMaker::make(Workshop& workshop, const cages::Wish& wish, const pose::Deformer& deformer,
                                sym3::Method method, base::Progress& progress) {
  Made all;
  const bool is_preview = wish.effort == cages::Effort::preview;
  progress.section(0, is_preview ? 1 : 0.7);
  {
    base::WorkerPool pool;
    if (!workshop.maker) {
      auto core = workshop.splats ? cages::core_of(workshop.model, *workshop.splats)
                                  : cages::CaptureCore{workshop.model, ""};
      workshop.maker.emplace(std::move(core.surface));
      workshop.note = std::move(core.note);
    }
    cages::Made made = workshop.maker->make(wish, pool, &progress);
    all.notes = std::move(made.notes);
    if (!workshop.note.empty()) all.notes.push_back(workshop.note);
    all.surface = document::generated_surface(std::move(made.surface), "made here");
  }
  if (!is_preview) progress.section(0.7, 0.75);
  all.cage = std::make_shared<const pose::Cage>(pose::make_cage(*all.surface.surface));
  if (is_preview) return all;
  progress.section(0.75, 1);
  all.bound = app::bind({workshop.model, all.cage, workshop.splats}, deformer, method, {}, progress);
  return all;
}

double CageMaker::due_in(const workspace::Workspace& w, bool no_drag) const {
  if (!w.making.open) return job_.running() || asked_ ? 0 : base::never;
  if (!no_drag) return base::never;
  if (job_.has_result()) return 0;
  if (!is_wished(w)) return !job_.running() || effort_ == cages::Effort::full ? 0 : base::never;
  if (job_.running()) return base::never;
  if (w.making.closing) return 0;
  return wants_full_ ? base::seconds_until(asked_at_ + rest_seconds) : base::never;
}

bool CageMaker::follow(workspace::Workspace& w, bool no_drag) {
  bool news = false;
  if (!w.making.open) {
    job_.cancel();
    asked_.reset();
    workshop_.reset();
    wants_full_ = false;
  } else if (no_drag) {
    if (auto result = job_.poll()) {
      news = true;
      // If the preview was replaced or posed, the full-quality cage is obsolete.
      const bool wanted =
          effort_ == cages::Effort::preview || document::can_replace_generated(w.document, w.making);
      if (result->value && wanted) take(w, *std::move(result->value));
      if (result->value) w.messages.succeeded("make cage");
      if (!result->problem.empty()) w.messages.error(result->problem, {"make cage", workspace::Scope::model});
      wants_full_ &= result->value.has_value();
    }
    // Does not cancel a running preview: otherwise, a dragged slider would never show a preview.
    const bool busy = job_.running() && effort_ == cages::Effort::preview;
    if (!is_wished(w) && !busy) start(w, cages::Effort::preview);
    wants_full_ &= job_.running() || document::can_replace_generated(w.document, w.making);
    if (wants_full_ && due_in(w, true) <= 0) start(w, cages::Effort::full);
    if (w.making.closing && is_wished(w) && !job_.running() && !wants_full_) close(w);
  }
  w.jobs.making_cage = job_.state();
  return news;
}

void CageMaker::start(const workspace::Workspace& w, cages::Effort effort) {
  const document::Document& document = w.document;
  if (effort == cages::Effort::preview) asked_at_ = base::wall_seconds();
  asked_ = w.making.wish;
  effort_ = effort;
  wants_full_ = effort == cages::Effort::preview && w.making.wish.kind == cages::Kind::automatic;
  cages::Wish wish = *asked_;
  wish.effort = effort;
  if (!workshop_ || workshop_->model != document.model().surface)
    workshop_ = std::make_shared<Workshop>(Workshop{document.model().surface, document.model().splats});
  job_.start([workshop = workshop_, wish, deformer = document.deformer(), method = document.method()](
                 base::Progress& progress) { return make(*workshop, wish, deformer, method, progress); },
             text_of(wish));
}

void CageMaker::take(workspace::Workspace& w, Made&& made) {
  bound_ = std::move(made.bound);
  is_preview_ = effort_ == cages::Effort::preview && w.making.wish.kind == cages::Kind::automatic;
  document::put_generated(w.document, w.making, std::move(made.surface), std::move(made.cage),
                          std::move(made.notes));
  if (!w.making.closing) return;
  // The panel is closed, so the notes on the cage are shown as messages.
  for (const std::string& note : w.making.notes)
    w.messages.warn("New cage: " + note + ".", {.scope = workspace::Scope::cage});
}

void CageMaker::close(workspace::Workspace& w) {
  if (is_preview_ && document::shows_generated(w.document, w.making))
    w.messages.warn(
        "The preview of the cage was kept. It encloses the model, but parts are closer than the margin.",
        {.scope = workspace::Scope::cage});
  w.making = {.wish = w.making.wish};
}

void CageMaker::stop(workspace::Workspace& w) {
  if (!job_.running()) return;
  job_.cancel();
  wants_full_ = false;
  w.messages.info("Cancelled; the cage is unchanged.");
}

}  // namespace viete::app
