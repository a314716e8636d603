// Work on other threads, so that frames are not delayed.
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

/// True if the future has a value. Waits for it at most this number of seconds.
template <class Value>
bool is_ready(const std::future<Value>& future, double seconds = 0) {
  return future.valid() &&
         future.wait_for(std::chrono::duration<double>(seconds)) == std::future_status::ready;
}

/// Runs work on a thread, in the order of add(). If the system cannot create a thread, add() runs the work
/// itself. Must be used by one thread only. The destructor waits for all work.
class BackgroundQueue {
public:
  BackgroundQueue() = default;
  ~BackgroundQueue();
  BackgroundQueue(const BackgroundQueue&) = delete;
  BackgroundQueue& operator=(const BackgroundQueue&) = delete;

  /// The future gets the result or the exception of the work.
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

/// The progress of background work, to be shown to the user.
struct WorkState {
  bool running = false;
  std::string what{};  ///< the step, for example "Reading dragon.ply"
  double done = 0;     ///< in [0, 1]
  double seconds = 0;  ///< time since the step began
  double age = 0;      ///< time since the work began
};

/// The estimated remaining seconds, or nullopt if it is too early for an estimate.
std::optional<double> time_left(double done, double seconds);

class StepProgress : public Progress {
public:
  explicit StepProgress(std::string name) : name_(std::move(name)) {}

  /// Begins the next step, whose progress starts at 0. The working thread calls it.
  void step(std::string name);
  WorkState state() const;

private:
  mutable std::mutex mutex_;
  std::string name_;
  double begun_ = wall_seconds(), step_begun_ = begun_;
};

/// Runs one job at a time. Must be used by one thread only. start() and cancel() do not wait for a running
/// job, which ends at its next progress report; then the next job begins. The destructor cancels the job and
/// waits for its end.
template <class Value>
class BackgroundJob {
public:
  struct Result {
    std::optional<Value> value{};  ///< empty if the job failed or was stopped
    std::string problem{};         ///< what() of the exception if the job failed
    bool stopped = false;
  };

  BackgroundJob() = default;
  ~BackgroundJob() { cancel(); }
  BackgroundJob(const BackgroundJob&) = delete;
  BackgroundJob& operator=(const BackgroundJob&) = delete;

  /// Cancels the running job and starts another. The user sees `name` in state().
  void start(std::function<Value(StepProgress&)> work, std::string name = "") {
    cancel();
    progress_ = std::make_shared<StepProgress>(std::move(name));
    value_ = queue_.add([progress = progress_, work = std::move(work)] {
      progress->report(0);  // throws if the job was cancelled before it began
      return work(*progress);
    });
  }

  void cancel() {
    stop();
    value_ = {};
  }

  /// Asks the job to stop. poll() still returns a result, which is `stopped` or complete.
  void stop() {
    if (running()) progress_->cancel();
  }

  /// True from start() until poll() returns the result.
  bool running() const { return value_.valid(); }
  WorkState state() const { return running() ? progress_->state() : WorkState{}; }
  bool has_result() const { return is_ready(value_); }

  /// Returns the result once, when it is available or, if `wait` is true, after waiting for it.
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
  std::shared_ptr<StepProgress> progress_;
  std::future<Value> value_;
  BackgroundQueue queue_;
};

}  // namespace viete::base
