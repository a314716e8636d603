// Clocks for wall time and for the processor time of a thread.
#pragma once

#include <algorithm>
#include <chrono>
#include <limits>

#include "base/os.h"

namespace viete::base {

/// Returns wall time in seconds since a fixed moment. The time never decreases.
inline double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A time in seconds that never comes.
inline constexpr double never = std::numeric_limits<double>::infinity();

/// Returns the seconds from now until a moment of wall_seconds(); 0 if the moment has passed.
inline double seconds_until(double moment) {
  return std::max(0.0, moment - wall_seconds());
}

/// Returns the calling thread's processor time in seconds. On a busy computer, it varies less than wall time.
inline double thread_seconds() {
  return os::thread_seconds();
}

/// Measures wall time in milliseconds since its construction or the last lap_ms().
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
