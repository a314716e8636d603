// Times and errors of every method, on whole frames and on a sample of the frame's matrices.
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

inline constexpr std::size_t probe_limit = 2048;

/// NaN where an error is; 0 of none.
std::pair<double, double> worst_and_median(std::vector<double> errors);

/// At most so many of the matrices, evenly spread.
std::vector<sym3::Sym3<double>> spread_sample(std::span<const sym3::Sym3<double>> matrices, std::size_t most);

/// Times and errors of all compared methods on these matrices: medians of interleaved runs in processor time,
/// errors against the reference of 106 bits.
scene::MethodStats measure_methods(std::span<const sym3::Sym3<double>> matrices);

/// Measures the newest sample it was given in the background, and rests in between.
class MethodProbe {
public:
  /// True when it would take a new sample now: it is idle and a third of a second has passed.
  bool ready() const;
  /// Copies at most 2,048 of the matrices, evenly spread.
  void offer(std::span<const sym3::Sym3<double>> matrices);
  /// What is being measured is not wanted any more.
  void forget() { job_.cancel(); }
  /// The newest result, each only once. With wait, waits for the one that is being measured.
  std::optional<scene::MethodStats> poll(bool wait = false);
  /// True when poll() would give a result.
  bool has_result() const { return job_.has_result(); }

private:
  base::BackgroundJob<scene::MethodStats> job_;
  double last_ = -1;
};

}  // namespace viete::app
