// fork() while other threads are at work.
#pragma once

namespace viete::base {

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
