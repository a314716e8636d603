// base/os.h for threads of Linux and other POSIX systems.
#include <ctime>

#include "base/os.h"

namespace viete::base::os {

double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t old) {
  value.wait(old);
}

void wake_all(std::atomic<std::uint32_t>& value) {
  value.notify_all();
}

}  // namespace viete::base::os
