// Work that runs aside, so that no frame waits for it.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "base/progress.h"

namespace viete::app {

/// One job at a time, in a thread of its own. Call from one thread. Starting another one, or cancelling, does
/// not wait for the one that runs: it ends by itself when it next reports. The destructor waits.
template <class Value>
class BackgroundJob {
public:
  struct Result {
    std::optional<Value> value;  ///< nothing when it failed or was stopped
    std::string problem;
    bool stopped = false;
  };

  BackgroundJob() = default;
  ~BackgroundJob() {
    cancel();
    for (const auto& job : left_) job->thread.join();
  }
  BackgroundJob(const BackgroundJob&) = delete;
  BackgroundJob& operator=(const BackgroundJob&) = delete;

  void start(std::function<Value(base::Progress&)> work) {
    cancel();
    job_ = std::make_unique<Job>();
    job_->begun = base::wall_seconds();
    job_->thread = std::thread([job = job_.get(), work = std::move(work)] { run(*job, work); });
  }

  /// Its result will not come.
  void cancel() {
    if (!job_) return;
    job_->progress.cancel();
    left_.push_back(std::move(job_));
  }

  /// Asks it to stop: its result comes all the same, and says whether it did or was finished before.
  void stop() {
    if (job_) job_->progress.cancel();
  }

  bool running() const { return job_ != nullptr; }
  double done() const { return job_ ? job_->progress.done() : 0; }
  /// Since it began.
  double seconds() const { return job_ ? base::wall_seconds() - job_->begun : 0; }
  bool has_result() const { return job_ && job_->finished.load(std::memory_order_acquire); }

  /// The result once it is there, each only once. With wait, waits for it.
  std::optional<Result> poll(bool wait = false) {
    reap();
    if (!job_ || (!wait && !has_result())) return std::nullopt;
    job_->thread.join();
    Result result = std::move(job_->result);
    job_.reset();
    return result;
  }

private:
  struct Job {
    base::Progress progress;
    std::atomic<bool> finished{false};
    Result result;
    double begun = 0;
    std::thread thread;
  };

  // Those that have ended by now, with what they hold.
  void reap() {
    std::erase_if(left_, [](const auto& job) {
      const bool finished = job->finished.load(std::memory_order_acquire);
      if (finished) job->thread.join();
      return finished;
    });
  }

  static void run(Job& job, const std::function<Value(base::Progress&)>& work) {
    try {
      job.result.value = work(job.progress);
    } catch (const base::Cancelled&) {
      job.result.stopped = true;
    } catch (const std::exception& error) {
      job.result.problem = error.what();
    }
    job.finished.store(true, std::memory_order_release);
  }

  std::unique_ptr<Job> job_;
  std::vector<std::unique_ptr<Job>> left_;  // cancelled, and not seen to have ended
};

}  // namespace viete::app
