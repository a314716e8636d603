// Opens files aside, so that the view stays live: reads them, and binds the model to its cage.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "app/bound.h"
#include "app/model_layer.h"
#include "base/background.h"
#include "scene/files/open.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

/// One request at a time in a thread of its own. Starting another stops the one that runs. Call from one
/// thread. A document comes with its binding or not at all, so that whatever goes wrong, what is open stays.
class Loader {
public:
  struct Loaded {
    scene::Opened opened;
    ModelShading shading;                       ///< of a new model
    Bound bound;                                ///< of a new model or cage
    std::optional<scene::Question> question{};  ///< nothing was opened: how it can be
    scene::OpenRequest request{};               ///< likewise: what was asked for
  };
  using Job = base::BackgroundJob<Loaded>;

  void start(const scene::OpenRequest& request, const scene::Document& current);
  /// Asks the work to stop; it does so within moments, and poll() then says so.
  void stop() { job_.stop(); }
  bool running() const { return job_.running(); }
  /// What is done now, how much of it, and for how long.
  scene::WorkState state() const;
  /// The result once it is there, each only once. With wait, waits for it.
  std::optional<Job::Result> poll(bool wait = false) { return job_.poll(wait); }
  /// What was done last was binding rather than reading.
  bool was_binding() const { return part_ && part_->binds; }

private:
  // What is done now, and since when.
  struct Part {
    void begin(std::string name);

    mutable std::mutex mutex;
    std::string what;
    double begun = 0;
    std::atomic<bool> binds = false;
  };
  static Loaded load(const scene::OpenRequest& request, const scene::Document& current, Part& part,
                     base::Progress& progress);

  std::shared_ptr<Part> part_;
  Job job_;
};

}  // namespace viete::app
