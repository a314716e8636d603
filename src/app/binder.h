// Binds the model to the cage aside, so that the view stays live.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "base/progress.h"
#include "deform/binding.h"
#include "mesh/surface.h"

namespace viete::app {

/// One binding at a time in a thread of its own. Starting another cancels the one that runs. Call from one thread.
class Binder {
 public:
  struct Result {
    std::shared_ptr<const deform::Cage> cage;
    std::shared_ptr<const deform::Binding> binding;  ///< null when it failed
    std::string problem;
  };

  Binder() = default;
  ~Binder() { cancel(); }
  Binder(const Binder&) = delete;
  Binder& operator=(const Binder&) = delete;

  void start(std::shared_ptr<const mesh::Surface> model, std::shared_ptr<const deform::Cage> cage,
             deform::Coordinates coordinates);
  void cancel();
  bool running() const { return job_ != nullptr; }
  double done() const { return job_ ? job_->progress.done() : 0; }
  /// The result once it is there, each only once. With wait, waits for it.
  std::optional<Result> poll(bool wait = false);

 private:
  struct Job {
    base::Progress progress;
    std::atomic<bool> finished{false};
    Result result;
    std::thread thread;
  };
  std::unique_ptr<Job> job_;
};

}  // namespace viete::app
