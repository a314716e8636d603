// While a ThreadsLeft exists, the program can create at most `count` new threads.
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
