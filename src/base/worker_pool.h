// A pool of threads for loops.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace viete::base {

/// Returns a thread that runs the work. If the system cannot create a thread, the result is not joinable.
template <class Work>
std::jthread try_thread(Work work) {
  try {
    return std::jthread(std::move(work));
  } catch (const std::exception&) {  // std::system_error, std::bad_alloc
    return {};
  }
}

/// Threads that run the blocks of a loop. The size of blocks is fixed, so that results do not depend on the
/// number of threads. In a child process after fork(), the calling thread runs all blocks.
class WorkerPool {
public:
  /// `threads` is the largest number of threads, including the caller. 0 means one thread per processor.
  explicit WorkerPool(int threads = 0);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  int threads() const;

  /// The times of all loops until now, in seconds.
  struct Cost {
    double caller = 0;   ///< processor time of the thread that called for_blocks()
    double longest = 0;  ///< the sum over all loops of the processor time of the slowest thread
    double wall = 0;     ///< wall time; far above `longest` if other programs use the processor

    Cost operator-(const Cost& earlier) const {
      return {caller - earlier.caller, longest - earlier.longest, wall - earlier.wall};
    }
  };
  Cost cost() const;

  /// Calls body(begin, end) on all threads for blocks that cover [0, count), and waits until all calls end.
  /// Rethrows the first exception of `body`. Two threads must not call for_blocks() at the same time. `body`
  /// must not call for_blocks().
  void for_blocks(std::size_t count, std::size_t block,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The number of elements per block, for loops over large arrays.
inline constexpr std::size_t large_block = std::size_t{1} << 15;

/// Like WorkerPool::for_blocks(), with a pool for this loop only. A single block runs in the calling thread.
void for_blocks(std::size_t count, const std::function<void(std::size_t begin, std::size_t end)>& body,
                std::size_t block = large_block);

/// Returns the sum of body(begin, end) over all blocks, computed with add(sum, result) in block order.
template <class Body, class Add = std::plus<>>
auto sum_of_blocks(std::size_t count, const Body& body, const Add& add = {}) {
  std::vector<decltype(body(0, 0))> sums((count + large_block - 1) / large_block);
  for_blocks(count,
             [&](std::size_t begin, std::size_t end) { sums[begin / large_block] = body(begin, end); });
  decltype(body(0, 0)) sum{};
  for (const auto& s : sums) sum = add(std::move(sum), s);
  return sum;
}

}  // namespace viete::base
