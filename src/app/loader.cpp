#include "app/loader.h"

#include <utility>

#include "base/clock.h"

namespace viete::app {

namespace {

// The undo history stays where it is: it may be large, and no reading needs it.
scene::Document without_history(const scene::Document& document) {
  scene::Document copy;
  copy.model = document.model;
  copy.cage_file = document.cage_file;
  copy.cage = document.cage;
  return copy;
}

}  // namespace

void Loader::start(const scene::OpenRequest& request, const scene::Document& current) {
  cancel();
  job_ = std::make_unique<Job>();
  job_->request = request;
  job_->current = without_history(current);
  job_->begun = base::wall_seconds();
  job_->thread = std::thread([job = job_.get()] { work(*job); });
}

void Loader::work(Job& job) {
  try {
    scene::Opened opened = scene::open_files(job.request, job.current, &job.progress);
    if (opened.document && opened.document->model.surface != job.current.model.surface) {
      job.progress.section(0.8, 1);
      job.result.look = look_of(opened.document->model.surface);
    }
    job.progress.section(1, 1);
    job.result.opened = std::move(opened);
  } catch (const base::Cancelled&) {
    job.result = {};
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

scene::LoadState Loader::state() const {
  if (!job_) return {};
  const auto& files = job_->request.files;
  const std::string name = files.empty() ? "" : files.front().filename().string();
  return {true, "Reading " + name, job_->progress.done(), base::wall_seconds() - job_->begun};
}

std::optional<Loader::Result> Loader::poll(bool wait) {
  if (!job_ || (!wait && !job_->finished.load(std::memory_order_acquire))) return std::nullopt;
  job_->thread.join();
  Result result = std::move(job_->result);
  job_.reset();
  return result;
}

}  // namespace viete::app
