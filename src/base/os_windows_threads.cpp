// base/os.h for threads of Windows.
#define NOMINMAX
#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <algorithm>
#include <chrono>

#include "base/os.h"

namespace viete::base::os {

namespace {

// Thread times have steps of 15 ms, cycle counts are exact. Returns the seconds of a cycle: the least of a
// few measurements, because other programs can interrupt one. 0 if cycles are not counted, as with Wine.
double seconds_of_cycle() {
  using Clock = std::chrono::steady_clock;
  double least = 0;
  for (int i = 0; i < 5; ++i) {
    ULONG64 first = 0, last = 0;
    const auto begun = Clock::now();
    QueryThreadCycleTime(GetCurrentThread(), &first);
    while (Clock::now() - begun < std::chrono::milliseconds(1)) {
    }
    QueryThreadCycleTime(GetCurrentThread(), &last);
    const double seconds = std::chrono::duration<double>(Clock::now() - begun).count();
    if (last <= first) return 0;
    const double cycle = seconds / static_cast<double>(last - first);
    least = i == 0 ? cycle : std::min(least, cycle);
  }
  return least;
}

}  // namespace

double thread_seconds() {
  static const double cycle = seconds_of_cycle();
  ULONG64 cycles = 0;
  if (cycle > 0 && QueryThreadCycleTime(GetCurrentThread(), &cycles))
    return cycle * static_cast<double>(cycles);
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// std::atomic::wait() of MinGW uses mutexes and semaphores, which cost 15 times as much.
void wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t old) {
  auto* address = const_cast<std::atomic<std::uint32_t>*>(&value);
  while (value.load() == old) WaitOnAddress(address, &old, sizeof old, INFINITE);
}

void wake_all(std::atomic<std::uint32_t>& value) {
  WakeByAddressAll(&value);
}

}  // namespace viete::base::os
