// Measures every method on a sample of the frame's matrices, aside from the frame.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/background.h"
#include "scene/workspace/frame_stats.h"

namespace viete::app {

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
