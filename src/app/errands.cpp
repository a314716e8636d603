#include "app/errands.h"

#include <chrono>
#include <exception>
#include <utility>

namespace viete::app {

Errands::Errands() : thread_([this] { serve(); }) {}

Errands::~Errands() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Errands::add(std::function<void()> errand) {
  {
    const std::lock_guard lock(mutex_);
    queue_.push_back(std::move(errand));
  }
  changed_.notify_all();
}

bool Errands::wait(double seconds) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, std::chrono::duration<double>(seconds),
                           [this] { return queue_.empty() && !busy_; });
}

std::optional<std::string> Errands::problem() {
  const std::lock_guard lock(mutex_);
  return std::exchange(problem_, std::nullopt);
}

void Errands::serve() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return stop_ || !queue_.empty(); });
    if (queue_.empty()) return;
    const auto errand = std::move(queue_.front());
    queue_.pop_front();
    busy_ = true;
    lock.unlock();
    std::string problem;
    try {
      errand();
    } catch (const std::exception& error) {
      problem = error.what();
    }
    lock.lock();
    if (!problem.empty() && !problem_) problem_ = problem;
    busy_ = false;
    changed_.notify_all();
  }
}

}  // namespace viete::app
