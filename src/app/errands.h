// Small file work done aside, in order: what a frame must not wait for.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace viete::app {

/// One thread. Call from one other. The destructor finishes what was asked for.
class Errands {
public:
  Errands();
  ~Errands();
  Errands(const Errands&) = delete;
  Errands& operator=(const Errands&) = delete;

  /// The errand may throw: its message is then the problem, and the next ones are done all the same.
  void add(std::function<void()> errand);
  /// Until all is done, or so many seconds have passed; true if all is done.
  bool wait(double seconds);
  /// What went wrong first since the last call, once.
  std::optional<std::string> problem();

private:
  void serve();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> queue_;
  std::optional<std::string> problem_;
  bool busy_ = false, stop_ = false;
  std::thread thread_;
};

}  // namespace viete::app
