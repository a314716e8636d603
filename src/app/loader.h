// Opens files aside, so that the view stays live: reads them, and binds the model to its cage.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/bound.h"
#include "app/model_look.h"
#include "base/progress.h"
#include "scene/open.h"

namespace viete::app {

/// One request at a time in a thread of its own. Starting another stops the one that runs. Call from one
/// thread. A document comes with its binding or not at all, so that whatever goes wrong, what is open stays.
class Loader {
public:
  struct Result {
    std::optional<scene::Opened> opened;  ///< nothing when it failed or was stopped
    ModelLook look;                       ///< of a new model
    Bound bound;                          ///< of a new model or cage
    std::string problem;                  ///< empty when it was stopped
    bool was_binding = false;             ///< rather than reading, when it failed or was stopped
  };

  Loader() = default;
  ~Loader() { cancel(); }
  Loader(const Loader&) = delete;
  Loader& operator=(const Loader&) = delete;

  void start(const scene::OpenRequest& request, const scene::Document& current, SavedBindings saved);
  /// Asks the work to stop; it does so within moments, and poll() then gives a result without problem.
  void stop();
  bool running() const { return job_ != nullptr; }
  /// What is done now, how much of it, and for how long.
  scene::WorkState state() const;
  /// The result once it is there, each only once. With wait, waits for it.
  std::optional<Result> poll(bool wait = false);

private:
  struct Job {
    scene::OpenRequest request;
    scene::Document current;
    SavedBindings saved;
    base::Progress progress;
    std::atomic<bool> finished{false};
    Result result;
    double begun = 0;
    std::mutex mutex;  // of the part that is done now
    std::string what;
    double part_begun = 0;
    std::thread thread;

    void begin_part(std::string name);
  };
  static void work(Job& job);
  static void open(Job& job);
  void cancel();

  std::unique_ptr<Job> job_;
};

}  // namespace viete::app
