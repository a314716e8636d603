#include "app/binder.h"

#include <utility>

#include "base/worker_pool.h"

namespace viete::app {

void Binder::start(std::shared_ptr<const mesh::Surface> model, std::shared_ptr<const deform::Cage> cage,
                   deform::Coordinates coordinates) {
  cancel();
  job_ = std::make_unique<Job>();
  job_->result.cage = cage;
  job_->thread = std::thread([job = job_.get(), model = std::move(model), cage = std::move(cage), coordinates] {
    try {
      base::WorkerPool pool;
      job->result.binding = std::make_shared<const deform::Binding>(
          deform::bind(*model, *cage, coordinates, pool, &job->progress));
    } catch (const base::Cancelled&) {
      job->result.problem = "binding was cancelled";
    } catch (const std::exception& error) {
      job->result.problem = error.what();
    }
    job->finished.store(true, std::memory_order_release);
  });
}

void Binder::cancel() {
  if (!job_) return;
  job_->progress.cancel();
  job_->thread.join();
  job_.reset();
}

std::optional<Binder::Result> Binder::poll(bool wait) {
  if (!job_ || (!wait && !job_->finished.load(std::memory_order_acquire))) return std::nullopt;
  job_->thread.join();
  Result result = std::move(job_->result);
  job_.reset();
  return result;
}

}  // namespace viete::app
