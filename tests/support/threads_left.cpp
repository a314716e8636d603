#include "support/threads_left.h"

#include <dlfcn.h>
#include <pthread.h>

#include <atomic>
#include <cerrno>
#include <limits>

namespace {

constexpr int no_limit = std::numeric_limits<int>::max();
std::atomic<int> left{no_limit};

}  // namespace

// Replaces the system's function, which std::thread calls.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
                              void* argument) noexcept {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
  if (left != no_limit && left-- <= 0) return EAGAIN;
  return create(thread, attributes, start, argument);
}

namespace viete::test {

ThreadsLeft::ThreadsLeft(int count) {
  left = count;
}
ThreadsLeft::~ThreadsLeft() {
  left = no_limit;
}

}  // namespace viete::test
