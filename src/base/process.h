// A unique name of this process, and protection from fork().
#pragma once

#include <string>
#include <string_view>

namespace viete::base {

/// "PID-START", where START is the start time. If the system reuses a process ID, the name differs.
std::string process_name();

/// True if the process with this name is running. False for a zombie, for a process that cannot be inspected,
/// and for a text that is not a name.
bool process_runs(std::string_view name);

/// While a ForkDelay exists, fork() waits in all other threads, so that the child does not inherit
/// half-changed data or locked mutexes. A thread may have several at once.
class ForkDelay {
public:
  ForkDelay();
  ~ForkDelay();
  ForkDelay(const ForkDelay&) = delete;
  ForkDelay& operator=(const ForkDelay&) = delete;
};

}  // namespace viete::base
