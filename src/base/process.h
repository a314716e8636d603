// This process: its name for other processes, and fork() beside running threads.
#pragma once

#include <string>
#include <string_view>

namespace viete::base {

/// "PID-START", START in clock ticks since the machine was started, so that a reused number is another name.
std::string process_name();

/// False for a name that is not of this form, and of a zombie. A process that cannot be looked at counts as
/// ended.
bool process_runs(std::string_view name);

/// While one lives, fork() in another thread waits, so that the child inherits no half-changed state and no
/// lock that nobody will release. In one thread they may be nested; its own do not delay its fork().
class ForkDelay {
public:
  ForkDelay();
  ~ForkDelay();
  ForkDelay(const ForkDelay&) = delete;
  ForkDelay& operator=(const ForkDelay&) = delete;
};

}  // namespace viete::base
