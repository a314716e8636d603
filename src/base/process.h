// The name of this process, and fork() with running threads.
#pragma once

#include <string>
#include <string_view>

namespace viete::base {

/// "PID-START", START in clock ticks since boot, so that a reused process ID has another name.
std::string process_name();

/// False for a name of another form and for a zombie. A process that cannot be inspected counts as ended.
bool process_runs(std::string_view name);

/// While one exists, fork() in other threads waits, so that the child does not inherit half-changed state or
/// locks that are never released. May be nested in one thread; does not delay fork() of its own thread.
class ForkDelay {
public:
  ForkDelay();
  ~ForkDelay();
  ForkDelay(const ForkDelay&) = delete;
  ForkDelay& operator=(const ForkDelay&) = delete;
};

}  // namespace viete::base
