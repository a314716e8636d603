// Measures every method on a sample of the frame's matrices, aside from the frame.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <vector>

#include "scene/frame_stats.h"

namespace viete::app {

inline constexpr std::size_t probe_limit = 2048;

/// Times and errors of all compared methods on these matrices: medians of interleaved runs in processor time,
/// errors against the reference of 106 bits.
scene::MethodStats measure_methods(std::span<const sym3::Sym3<double>> matrices);

/// A thread that measures the newest sample it was given, again and again as long as new ones come, and rests
/// in between.
class MethodProbe {
public:
  MethodProbe();
  ~MethodProbe();
  MethodProbe(const MethodProbe&) = delete;
  MethodProbe& operator=(const MethodProbe&) = delete;

  /// True when it would take a new sample now: it is idle and a third of a second has passed.
  bool ready() const;
  /// Copies at most 2,048 of the matrices, evenly spread.
  void offer(std::span<const sym3::Sym3<double>> matrices);
  /// The newest result, each only once.
  std::optional<scene::MethodStats> poll();
  /// True when poll() would give a result.
  bool has_result() const;
  /// True while a sample is being measured.
  bool busy() const;

private:
  void serve();

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<sym3::Sym3<double>> sample_;
  std::optional<scene::MethodStats> result_;
  bool busy_ = false, stop_ = false;
  double last_ = -1;
  std::thread thread_;
};

}  // namespace viete::app
