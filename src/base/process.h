// A unique name for this process, and protection from fork().
#pragma once

#include <string>
#include <string_view>

namespace viete::base {

/// Returns "PID-START", where START is the start time. A later process with an equal ID has another name.
std::string process_name();

/// True if the process with this name is running. False for a zombie, for a process that cannot be inspected,
/// and for a text that is not a process name.
bool process_runs(std::string_view name);

/// While a ForkDelay exists, fork() waits in all other threads. The child then cannot inherit half-changed
/// data or locked mutexes. A thread may have several ForkDelays at once.
class ForkDelay {
public:
  ForkDelay();
  ~ForkDelay();
  ForkDelay(const ForkDelay&) = delete;
  ForkDelay& operator=(const ForkDelay&) = delete;
};

}  // namespace viete::base
