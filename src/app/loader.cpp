#include "app/loader.h"

#include <utility>

#include "base/clock.h"
#include "scene/binding_plan.h"

namespace viete::app {

namespace {

// The undo history stays where it is: it may be large, and no reading needs it.
scene::Document without_history(const scene::Document& document) {
  scene::Document copy;
  copy.model = document.model;
  copy.cage_file = document.cage_file;
  copy.cage = document.cage;
  copy.method = document.method;
  copy.coordinates = document.coordinates;
  copy.reach = document.reach;
  return copy;
}

}  // namespace

void Loader::start(const scene::OpenRequest& request, const scene::Document& current, SavedBindings saved) {
  cancel();
  job_ = std::make_unique<Job>();
  job_->request = request;
  job_->current = without_history(current);
  job_->saved = std::move(saved);
  job_->begun = base::wall_seconds();
  const auto& files = request.files;
  job_->begin_part("Reading " + (files.empty() ? "" : files.front().filename().string()));
  job_->thread = std::thread([job = job_.get()] { work(*job); });
}

void Loader::Job::begin_part(std::string name) {
  const std::lock_guard lock(mutex);
  what = std::move(name);
  part_begun = base::wall_seconds();
}

void Loader::open(Job& job) {
  scene::Opened opened = scene::open_files(job.request, job.current, &job.progress);
  scene::check_drawable(opened);
  if (opened.document && opened.document->model.surface != job.current.model.surface) {
    job.progress.section(0.8, 1);
    job.result.look = look_of(opened.document->model.surface);
  }
  job.progress.section(1, 1);
  if (opened.document && opened.document->has_cage()) {
    const scene::Document& document = *opened.document;
    const scene::Document& settings = opened.session ? document : job.current;  // that take() will leave
    const auto weighting = settings.weighting();
    job.result.was_binding = true;
    job.begin_part(scene::text(scene::binding_plan(document, weighting.coordinates)));
    job.progress.section(0, 1);
    job.result.bound =
        bind(document.model.surface, document.cage, weighting, settings.method, {}, job.saved, job.progress);
  }
  job.result.opened = std::move(opened);
}

void Loader::work(Job& job) {
  try {
    open(job);
  } catch (const base::Cancelled&) {
  } catch (const std::exception& error) {
    job.result.problem = error.what();
  }
  job.finished.store(true, std::memory_order_release);
}

void Loader::stop() {
  if (job_) job_->progress.cancel();
}

void Loader::cancel() {
  if (!job_) return;
  stop();
  job_->thread.join();
  job_.reset();
}

scene::WorkState Loader::state() const {
  if (!job_) return {};
  const std::lock_guard lock(job_->mutex);
  const double now = base::wall_seconds();
  return {true, job_->what, job_->progress.done(), now - job_->part_begun, now - job_->begun};
}

std::optional<Loader::Result> Loader::poll(bool wait) {
  if (!job_ || (!wait && !job_->finished.load(std::memory_order_acquire))) return std::nullopt;
  job_->thread.join();
  Result result = std::move(job_->result);
  job_.reset();
  return result;
}

}  // namespace viete::app
