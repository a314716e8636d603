// Opens files in the background, so that the view stays responsive: reads them, and binds the model to its
// cage.
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

/// One request at a time in its own thread; a new one cancels the previous. Call from one thread. A document
/// is delivered only together with its binding, so that failures leave the open document unchanged.
class Loader {
public:
  struct Loaded {
    scene::Opened opened;
    ModelShading shading;                       ///< looks of a new model
    Bound bound;                                ///< binding of a new model or cage
    std::optional<scene::Question> question{};  ///< if nothing was opened: how to proceed
    scene::OpenRequest request{};               ///< if nothing was opened: the request
  };
  using Job = base::BackgroundJob<Loaded>;

  void start(const scene::OpenRequest& request, const scene::Document& current);
  /// Cancels the work, which ends soon; poll() then reports it.
  void stop() { job_.stop(); }
  bool running() const { return job_.running(); }
  /// The current step, its progress and duration.
  scene::WorkState state() const;
  /// The result once it is available; returned only once. With `wait`, waits for it.
  std::optional<Job::Result> poll(bool wait = false) { return job_.poll(wait); }
  /// True if the last step was binding, not reading.
  bool was_binding() const { return part_ && part_->binds; }

private:
  // The current step and its start.
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
