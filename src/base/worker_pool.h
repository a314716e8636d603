// Threads, and a pool of them that lives as long as the program and shares loops over fixed blocks.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <thread>
#include <utility>

namespace viete::base {

/// A thread that runs the work, which may take a std::stop_token; not joinable if the system refuses it.
template <class Work>
std::jthread try_thread(Work work) {
  try {
    return std::jthread(std::move(work));
  } catch (const std::exception&) {  // std::system_error, std::bad_alloc
    return {};
  }
}

/// A persistent pool for data-parallel loops. Blocks have a fixed size that does not depend on the number
/// of threads, and each block is computed by one thread alone, so results are the same for any number. In a
/// child of fork(), where there are no other threads, the caller does all of it.
class WorkerPool {
public:
  /// threads: at most, as the system allows; the caller included. 0 means one for each processor.
  explicit WorkerPool(int threads = 0);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  int threads() const;

  /// Seconds of processor time in all loops so far: of the thread that called for_blocks, and of whichever
  /// thread took longest in each. What a loop would take on a machine that does nothing else is the second.
  struct Cost {
    double caller = 0, longest = 0;
  };
  Cost cost() const;

  /// Calls body(begin, end) for consecutive blocks that cover [0, count), on all threads; returns when all
  /// are done. The first exception that a body throws is rethrown here. Only one thread may call it at a
  /// time; not reentrant.
  void for_blocks(std::size_t count, std::size_t block,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace viete::base
