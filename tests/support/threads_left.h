// A system that allows only so many more threads, as long as it lives.
#pragma once

namespace viete::test {

class ThreadsLeft {
public:
  explicit ThreadsLeft(int count);
  ~ThreadsLeft();
  ThreadsLeft(const ThreadsLeft&) = delete;
  ThreadsLeft& operator=(const ThreadsLeft&) = delete;
};

}  // namespace viete::test
