// Work that is done in the background, so that no frame waits for it.
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

/// True if the future has its value, or has it within so many seconds.
template <class Value>
bool is_ready(const std::future<Value>& future, double seconds = 0) {
  return future.valid() &&
         future.wait_for(std::chrono::duration<double>(seconds)) == std::future_status::ready;
}

/// One thread that does what it is given, in order; it begins with the first work. If the system allows no
/// thread, add() does the work itself. Call from one other thread. The destructor waits until all is done.
class BackgroundQueue {
public:
  BackgroundQueue() = default;
  ~BackgroundQueue();
  BackgroundQueue(const BackgroundQueue&) = delete;
  BackgroundQueue& operator=(const BackgroundQueue&) = delete;

  /// The future has what the work returns or throws; the next work is done all the same.
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

/// One job at a time. Call from one thread. Starting another one, or cancelling, does not wait for the one
/// that runs: it ends when it next reports, and then the other one begins. The destructor cancels and waits.
template <class Value>
class BackgroundJob {
public:
  struct Result {
    std::optional<Value> value{};  ///< nothing when it failed or was stopped
    std::string problem{};         ///< what(), when it failed
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
      progress->report(0);  // where it was cancelled before it began
      return work(*progress);
    });
  }

  /// Its result will not come.
  void cancel() {
    stop();
    value_ = {};
  }

  /// Asks it to stop: its result comes all the same, and says whether it did or was finished before.
  void stop() {
    if (running()) progress_->cancel();
  }

  /// True from its start until its result is taken.
  bool running() const { return value_.valid(); }
  /// In [0, 1].
  double done() const { return running() ? progress_->done() : 0; }
  /// Since it was started.
  double seconds() const { return running() ? wall_seconds() - begun_ : 0; }
  bool has_result() const { return is_ready(value_); }
  void wait() const {
    if (running()) value_.wait();
  }

  /// The result once it is there, each only once. With wait, waits for it.
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
