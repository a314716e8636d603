#include "base/background.h"

#include "base/worker_pool.h"

namespace viete::base {

BackgroundQueue::~BackgroundQueue() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void BackgroundQueue::push(std::function<void()> task) {
  if (!thread_.joinable()) thread_ = try_thread([this] { serve(); });
  if (!thread_.joinable()) return task();
  {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  changed_.notify_all();
}

void BackgroundQueue::serve() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return ends_ || !tasks_.empty(); });
    if (tasks_.empty()) return;
    {
      const auto task = std::move(tasks_.front());
      tasks_.pop_front();
      lock.unlock();
      task();
    }  // destroys the finished task before the next task begins
    if (wake_) wake_();
    lock.lock();
  }
}

std::optional<double> time_left(double done, double seconds) {
  constexpr double known = 0.01, surely = 1;
  if (done < known || seconds < surely) return std::nullopt;
  return seconds * (1 - done) / done;
}

void StepProgress::step(std::string name) {
  const std::lock_guard lock(mutex_);
  name_ = std::move(name);
  step_begun_ = wall_seconds();
  section(0, 1);
}

WorkState StepProgress::state() const {
  const std::lock_guard lock(mutex_);
  const double now = wall_seconds();
  return {true, name_, done(), now - step_begun_, now - begun_};
}

}  // namespace viete::base
