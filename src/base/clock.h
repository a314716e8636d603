// Clocks: wall time for waiting, thread time for the cost of a computation.
#pragma once

#include <chrono>
#include <ctime>

namespace viete::base {

/// Seconds of wall time since an arbitrary fixed moment; monotonic.
inline double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Seconds of processor time used by the calling thread. Less noisy than wall time on shared machines.
inline double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

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
