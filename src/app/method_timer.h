// Times and errors of every method, for whole frames and for a sample of the frame's matrices.
#pragma once

#include <memory>
#include <span>

#include "app/view_model.h"
#include "base/progress.h"

namespace viete::app {

struct MethodTimings {
  scene::MethodTimes times;
  /// The binding, including staged weights if they are small enough to compute without being requested.
  std::shared_ptr<const deform::Binding> binding;
};

/// Medians of interleaved frames, with its own deformer and pool. Throws base::Error if memory does not
/// suffice, and base::Cancelled between frames. Thread-safe.
MethodTimings time_methods(FrameInput timed, base::Progress& progress);

/// Times and errors of all compared methods on these matrices: medians of interleaved runs in CPU time,
/// errors against the 106-bit reference; NaN if one is.
scene::MethodStats measure_methods(std::span<const sym3::Sym3<double>> matrices);

}  // namespace viete::app
