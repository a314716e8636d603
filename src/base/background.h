// Runs work on other threads, so that the work does not delay frames.
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
#include "base/error.h"
#include "base/progress.h"

namespace viete::base {

/// Waits for at most this number of seconds. True if the future then has a value or an exception.
template <class Value>
bool is_ready(const std::future<Value>& future, double seconds = 0) {
  return future.valid() &&
         future.wait_for(std::chrono::duration<double>(seconds)) == std::future_status::ready;
}

/// Called by a background thread when work has ended, so that a waiting main loop looks at the result.
using Wake = std::function<void()>;

/// Runs work on a second thread, in the order of the add() calls. If the system cannot create this thread,
/// add() itself runs the work. Only one thread may call add(). The destructor waits for all work.
class BackgroundQueue {
public:
  /// `wake` may be null. It must be callable from any thread during the lifetime of the queue.
  explicit BackgroundQueue(Wake wake = nullptr) : wake_(std::move(wake)) {}
  ~BackgroundQueue();
  BackgroundQueue(const BackgroundQueue&) = delete;
  BackgroundQueue& operator=(const BackgroundQueue&) = delete;

  /// Adds work. The future gets the work's result or exception.
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

  Wake wake_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  bool ends_ = false;
  std::jthread thread_;
};

struct WorkState {
  bool running = false;
  std::string what{};  ///< the current step, for example "Reading dragon.ply"
  double done = 0;     ///< in [0, 1]
  double seconds = 0;  ///< seconds since the step began
  double age = 0;      ///< seconds since the work began
};

/// Estimates the remaining seconds. In the first second, and below 1 % of the work, returns nullopt.
std::optional<double> time_left(double done, double seconds);

class StepProgress : public Progress {
public:
  explicit StepProgress(std::string name) : name_(std::move(name)) {}

  /// Begins the next step, with the progress 0. The thread that does the work must call this.
  void step(std::string name);
  WorkState state() const;

private:
  mutable std::mutex mutex_;
  std::string name_;
  double begun_ = wall_seconds(), step_begun_ = begun_;
};

/// Runs one job at a time. Only one thread may use the object. start() and cancel() do not wait: a cancelled
/// job ends at its next progress report, and then the next job begins. The destructor cancels the job and
/// waits until the job ends.
template <class Value>
class BackgroundJob {
public:
  struct Result {
    std::optional<Value> value{};  ///< empty if the job failed or was stopped
    std::string problem{};         ///< message_of() the job's exception; empty if the job did not fail
    bool stopped = false;
  };

  /// See BackgroundQueue for `wake`.
  explicit BackgroundJob(Wake wake = nullptr) : queue_(std::move(wake)) {}
  ~BackgroundJob() { cancel(); }
  BackgroundJob(const BackgroundJob&) = delete;
  BackgroundJob& operator=(const BackgroundJob&) = delete;

  /// Cancels the running job and starts `work`. `name` is the name of the first step in state().
  void start(std::function<Value(StepProgress&)> work, std::string name = "") {
    cancel();
    progress_ = std::make_shared<StepProgress>(std::move(name));
    value_ = queue_.add([progress = progress_, work = std::move(work)] {
      progress->report(0);  // throws if the job was already cancelled
      return work(*progress);
    });
  }

  void cancel() {
    stop();
    value_ = {};
  }

  /// Asks the job to stop. poll() later returns `stopped`; or the result, if the job ends before it notices.
  void stop() {
    if (running()) progress_->cancel();
  }

  /// True from start() until cancel(), or until poll() has returned the result.
  bool running() const { return value_.valid(); }
  WorkState state() const { return running() ? progress_->state() : WorkState{}; }
  bool has_result() const { return is_ready(value_); }

  /// If the job has ended, returns its result once; otherwise nullopt. If `wait`, first waits for the end.
  std::optional<Result> poll(bool wait = false) {
    if (!running() || (!wait && !has_result())) return std::nullopt;
    try {
      return Result{.value = value_.get()};
    } catch (const Cancelled&) {
      return Result{.stopped = true};
    } catch (const std::exception& error) {
      return Result{.problem = message_of(error)};
    }
  }

private:
  std::shared_ptr<StepProgress> progress_;
  std::future<Value> value_;
  BackgroundQueue queue_;
};

}  // namespace viete::base
