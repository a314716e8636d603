// Background work that does not delay frames.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>

#include "base/clock.h"
#include "base/progress.h"

namespace viete::base {

/// True if the future has its value now, or gets it within this many seconds.
template <class Value>
bool is_ready(const std::future<Value>& future, double seconds = 0) {
  return future.valid() &&
         future.wait_for(std::chrono::duration<double>(seconds)) == std::future_status::ready;
}

/// A thread that runs work in order; it starts with the first work. If the system cannot create a thread,
/// add() runs the work itself. Call from one other thread. The destructor waits for all work.
class BackgroundQueue {
public:
  BackgroundQueue() = default;
  ~BackgroundQueue();
  BackgroundQueue(const BackgroundQueue&) = delete;
  BackgroundQueue& operator=(const BackgroundQueue&) = delete;

  /// The future gets the result or exception of the work; later work runs in either case.
  template <class Work>
  std::future<std::invoke_result_t<Work>> add(Work work) {
    auto task = std::make_shared<std::packaged_task<std::invoke_result_t<Work>()>>(std::move(work));
    auto result = task->get_future();
    push([task = std::move(task)] { (*task)(); });
    return result;
  }

private:
  void push(std::function<void()> task);
  void serve();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  bool ends_ = false;
  std::jthread thread_;
};

/// Runs one job at a time. Call from one thread. Starting another job, or cancelling, does not wait for the
/// running job: that ends at its next progress report, then the next job begins. The destructor cancels and
/// waits.
template <class Value>
class BackgroundJob {
public:
  struct Result {
    std::optional<Value> value{};  ///< empty if it failed or was stopped
    std::string problem{};         ///< what() of the exception, if it failed
    bool stopped = false;
  };

  BackgroundJob() = default;
  ~BackgroundJob() { cancel(); }
  BackgroundJob(const BackgroundJob&) = delete;
  BackgroundJob& operator=(const BackgroundJob&) = delete;

  void start(std::function<Value(Progress&)> work) {
    cancel();
    progress_ = std::make_shared<Progress>();
    begun_ = wall_seconds();
    value_ = queue_.add([progress = progress_, work = std::move(work)] {
      progress->report(0);  // throws if it was cancelled before it began
      return work(*progress);
    });
  }

  /// Cancels the job and discards its result.
  void cancel() {
    stop();
    value_ = {};
  }

  /// Asks the job to stop; its result still arrives, stopped or complete.
  void stop() {
    if (running()) progress_->cancel();
  }

  /// True from start() until the result is taken.
  bool running() const { return value_.valid(); }
  /// Progress in [0, 1].
  double done() const { return running() ? progress_->done() : 0; }
  /// Seconds since the start.
  double seconds() const { return running() ? wall_seconds() - begun_ : 0; }
  bool has_result() const { return is_ready(value_); }
  void wait() const {
    if (running()) value_.wait();
  }

  /// The result, once it is available; each is returned only once. With wait, waits for it.
  std::optional<Result> poll(bool wait = false) {
    if (!running() || (!wait && !has_result())) return std::nullopt;
    try {
      return Result{.value = value_.get()};
    } catch (const Cancelled&) {
      return Result{.stopped = true};
    } catch (const std::exception& error) {
      return Result{.problem = error.what()};
    }
  }

private:
  std::shared_ptr<Progress> progress_;
  std::future<Value> value_;
  double begun_ = 0;
  BackgroundQueue queue_;
};

}  // namespace viete::base
