// Times and errors of every method, for whole frames and for a sample of the frame's matrices.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "app/bound.h"
#include "base/background.h"
#include "base/progress.h"
#include "deform/deformer.h"
#include "scene/workspace/frame_stats.h"

namespace viete::app {

/// A pose of a bound model to time.
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
  /// The binding, including staged weights if they are small enough to compute without being requested.
  std::shared_ptr<const deform::Binding> binding;
};

/// Medians of interleaved frames, with its own deformer and pool. Throws base::Error if memory does not
/// suffice, and base::Cancelled between frames. Thread-safe.
MethodTimings time_methods(TimedPose timed, base::Progress& progress);

inline constexpr std::size_t probe_limit = 2048;

/// NaN if any error is NaN; 0 for an empty list.
std::pair<double, double> worst_and_median(std::vector<double> errors);

/// At most `most` of the matrices, evenly spread.
std::vector<sym3::Sym3<double>> spread_sample(std::span<const sym3::Sym3<double>> matrices, std::size_t most);

/// Times and errors of all compared methods on these matrices: medians of interleaved runs in CPU time,
/// errors against the 106-bit reference.
scene::MethodStats measure_methods(std::span<const sym3::Sym3<double>> matrices);

/// Measures the newest sample in the background, with pauses.
class MethodProbe {
public:
  /// True if it accepts a new sample: it is idle and a third of a second has passed.
  bool ready() const;
  /// Copies at most 2,048 of the matrices, evenly spread.
  void offer(std::span<const sym3::Sym3<double>> matrices);
  /// Discards the running measurement.
  void forget() { job_.cancel(); }
  /// The newest result; returned only once. With `wait`, waits for the running measurement.
  std::optional<scene::MethodStats> poll(bool wait = false);
  /// True when poll() would give a result.
  bool has_result() const { return job_.has_result(); }

private:
  base::BackgroundJob<scene::MethodStats> job_;
  double last_ = -1;
};

}  // namespace viete::app
