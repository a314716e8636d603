#include "base/fork.h"

#include <pthread.h>

#include <atomic>
#include <mutex>

namespace viete::base {

namespace {

// One for the process, as fork() is.
std::mutex entrance;          // held during fork()
std::atomic<int> inside = 0;  // threads that have a ForkDelay
thread_local int own = 0;     // of this thread

void before_fork() {
  entrance.lock();
  for (int all = inside; all > (own > 0); all = inside) inside.wait(all);
}

void after_fork() {
  entrance.unlock();
}

[[maybe_unused]] const int registered = pthread_atfork(before_fork, after_fork, after_fork);

}  // namespace

ForkDelay::ForkDelay() {
  if (own++ > 0) return;
  const std::lock_guard lock(entrance);
  ++inside;
}

ForkDelay::~ForkDelay() {
  if (--own > 0) return;
  --inside;
  inside.notify_all();
}

}  // namespace viete::base
