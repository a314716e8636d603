// Times whole deformations of one pose with every method.
#pragma once

#include <memory>

#include "app/bound.h"
#include "base/progress.h"
#include "deform/deformer.h"
#include "scene/workspace/frame_stats.h"

namespace viete::app {

/// A pose of a bound model, to be timed.
struct TimedPose {
  Bound bound;
  deform::Scheme scheme;
  bool all_staged = false;  ///< the staged engine for all methods
  deform::Pose pose;
  deform::Mask mask;
  deform::Probes probes;
  deform::SharedShape shape;
};

struct MethodTimings {
  scene::MethodTimes times;
  /// The binding, with the weights of the staged engine where these are small enough to be made unasked.
  std::shared_ptr<const deform::Binding> binding;
};

/// Medians of interleaved frames, with a deformer and a pool of its own. Throws base::Error where memory is
/// missing, and base::Cancelled between two frames. Thread-safe.
MethodTimings time_methods(TimedPose timed, base::Progress& progress);

}  // namespace viete::app
