// Limits the number of new threads while an object exists.
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
