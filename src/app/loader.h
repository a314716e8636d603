// Reads files aside, so that the view stays live.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "app/model_look.h"
#include "base/progress.h"
#include "scene/open.h"

namespace viete::app {

/// One request at a time in a thread of its own. Starting another stops the one that runs. Call from one
/// thread.
class Loader {
public:
  struct Result {
    std::optional<scene::Opened> opened;  ///< nothing when it failed or was stopped
    ModelLook look;                       ///< of a new model
    std::string problem;                  ///< empty when it was stopped
  };

  Loader() = default;
  ~Loader() { cancel(); }
  Loader(const Loader&) = delete;
  Loader& operator=(const Loader&) = delete;

  void start(const scene::OpenRequest& request, const scene::Document& current);
  /// Asks the work to stop; it does so within moments, and poll() then gives a result without problem.
  void stop();
  bool running() const { return job_ != nullptr; }
  /// The file that is read, how much of the work is done, and the seconds since it began.
  scene::LoadState state() const;
  /// The result once it is there, each only once. With wait, waits for it.
  std::optional<Result> poll(bool wait = false);

private:
  struct Job {
    scene::OpenRequest request;
    scene::Document current;
    base::Progress progress;
    std::atomic<bool> finished{false};
    Result result;
    double begun = 0;
    std::thread thread;
  };
  static void work(Job& job);
  void cancel();

  std::unique_ptr<Job> job_;
};

}  // namespace viete::app
