// A pool of threads for loops.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <thread>
#include <utility>

namespace viete::base {

/// A thread that runs the work. If the system cannot create a thread, the result is not joinable.
template <class Work>
std::jthread try_thread(Work work) {
  try {
    return std::jthread(std::move(work));
  } catch (const std::exception&) {  // std::system_error, std::bad_alloc
    return {};
  }
}

/// Threads that divide the blocks of a loop among them. The size of blocks is fixed, so results do not depend
/// on the number of threads. After fork(), the child process has no other threads and the caller runs all
/// blocks.
class WorkerPool {
public:
  /// `threads` is the largest number of threads, including the caller. 0 means one for each processor.
  explicit WorkerPool(int threads = 0);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  int threads() const;

  /// Processor time of all loops so far, in seconds.
  struct Cost {
    double caller = 0;   ///< time of the thread that called for_blocks()
    double longest = 0;  ///< time of the slowest thread of each loop: about the wall time on an idle machine
  };
  Cost cost() const;

  /// Calls body(begin, end) on all threads for blocks that cover [0, count), and waits until all calls are
  /// done. Rethrows the first exception of a body. Two threads must not call for_blocks() at the same time,
  /// and a body must not call it.
  void for_blocks(std::size_t count, std::size_t block,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace viete::base
