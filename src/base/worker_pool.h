// Threads, and a persistent pool for loops over fixed blocks.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace viete::base {

/// A thread that runs the work, which may take a std::stop_token; not joinable if the system cannot create
/// it.
template <class Work>
std::jthread try_thread(Work work) {
  try {
    return std::jthread(std::move(work));
  } catch (const std::exception&) {  // std::system_error, std::bad_alloc
    return {};
  }
}

/// A persistent pool for data-parallel loops. Blocks have a fixed size, and each is computed by one thread,
/// so results do not depend on the number of threads. In a child of fork(), which has no other threads, the
/// caller runs all blocks.
class WorkerPool {
public:
  /// threads: upper limit, including the caller, if the system allows. 0 means one per processor.
  explicit WorkerPool(int threads = 0);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  int threads() const;

  /// Seconds of processor time in all loops so far. caller: time of the thread that called for_blocks.
  /// longest: time of the slowest thread, summed over loops; estimates their time on an idle machine.
  struct Cost {
    double caller = 0, longest = 0;
  };
  Cost cost() const;

  /// Calls body(begin, end) for consecutive blocks that cover [0, count), on all threads; returns after all
  /// are done. Rethrows the first exception of a body. Must not be called by two threads at once or from a
  /// body.
  void for_blocks(std::size_t count, std::size_t block,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Elements per block of loops over large arrays.
inline constexpr std::size_t large_block = std::size_t{1} << 15;

/// WorkerPool::for_blocks() on threads for this loop alone; on the caller's if there is only one block.
void for_blocks(std::size_t count, const std::function<void(std::size_t begin, std::size_t end)>& body,
                std::size_t block = large_block);

/// The sum of body(begin, end) over those blocks, in their order. add(sum, term) adds to a sum.
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
