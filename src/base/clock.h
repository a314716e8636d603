// Clocks: wall time for waiting, thread time for the cost of a computation.
#pragma once

#include <chrono>

namespace viete::base {

/// Seconds of wall time since an arbitrary fixed moment; monotonic.
inline double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Seconds of processor time used by the calling thread. Less noisy than wall time on shared machines.
double thread_seconds();

/// Wall time in milliseconds since construction or the last lap.
class Stopwatch {
public:
  double lap_ms() {
    const double now = wall_seconds();
    const double ms = (now - start_) * 1e3;
    start_ = now;
    return ms;
  }

private:
  double start_ = wall_seconds();
};

}  // namespace viete::base
