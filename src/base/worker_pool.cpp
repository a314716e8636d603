#include "base/worker_pool.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <utility>

#include "base/clock.h"
#include "base/os.h"

namespace viete::base {

struct WorkerPool::State {
  const unsigned long process = os::process_id();
  std::vector<std::jthread> threads;  // threads[i] has the number i + 1; the caller has the number 0
  // Waiting threads look at this. The two lowest bits count changes of `last`, at most two; the rest counts
  // loops.
  std::atomic<std::uint32_t> news = 0;
  std::atomic<std::size_t> last = SIZE_MAX;  // threads with a higher number must end
  std::atomic<std::uint32_t> busy = 0;       // threads that have not finished this loop
  Cost cost;
  std::mutex mutex;  // guards the results of threads:
  std::exception_ptr error;
  double longest = 0;  // the processor time of the slowest thread in this loop, in seconds

  std::size_t count = 0, block = 1;
  const std::function<void(std::size_t, std::size_t)>* body = nullptr;

  // Runs the blocks of thread t of n threads, and returns the processor time. The blocks of a thread are
  // adjacent, so that adjacent memory stays on one core.
  double work(std::size_t t, std::size_t n) {
    const double begun = thread_seconds();
    const std::size_t blocks = (count + block - 1) / block;
    try {
      for (std::size_t b = blocks * t / n; b < blocks * (t + 1) / n; ++b) {
        (*body)(b * block, std::min(count, (b + 1) * block));
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!error) error = std::current_exception();
    }
    return thread_seconds() - begun;
  }

  void serve(std::size_t index) {
    for (std::uint32_t seen = 0;;) {
      os::wait_for_change(news, seen);
      const std::uint32_t before = std::exchange(seen, news.load());
      if (index > last) return;
      if (seen / 4 == before / 4) continue;
      const double seconds = work(index, threads.size() + 1);
      {
        const std::lock_guard lock(mutex);
        longest = std::max(longest, seconds);
      }
      if (--busy == 0) os::wake_all(busy);
    }
  }

  // Starts as many threads as the system allows. If the system refuses a thread, ends half of the threads, to
  // leave memory and threads to the rest of the program.
  void start(std::size_t wanted) {
    threads.reserve(wanted);
    while (threads.size() < wanted) {
      std::jthread thread = try_thread([this, index = threads.size() + 1] { serve(index); });
      if (!thread.joinable()) return end_beyond(threads.size() / 2);
      threads.push_back(std::move(thread));
    }
  }

  void end_beyond(std::size_t number) {
    last = number;
    ++news;
    os::wake_all(news);
    threads.resize(number);  // waits until the removed threads end
  }
};

WorkerPool::WorkerPool(int threads) : state_(std::make_unique<State>()) {
  if (threads <= 0) threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  state_->start(static_cast<std::size_t>(threads) - 1);
}

WorkerPool::~WorkerPool() {
  if (state_->process != os::process_id()) {  // in a child process after fork(), these threads do not exist
    for (auto& thread : state_->threads) thread.detach();
    static_cast<void>(state_.release());
    return;
  }
  state_->end_beyond(0);
}

int WorkerPool::threads() const {
  return static_cast<int>(state_->threads.size()) + 1;
}

WorkerPool::Cost WorkerPool::cost() const {
  return state_->cost;
}

void WorkerPool::for_blocks(std::size_t count, std::size_t block,
                            const std::function<void(std::size_t, std::size_t)>& body) {
  if (count == 0) return;
  State& s = *state_;
  block = std::max<std::size_t>(1, block);
  const double begun = wall_seconds();
  if (s.process != os::process_id()) {
    for (std::size_t begin = 0; begin < count; begin += block) body(begin, std::min(count, begin + block));
    return;
  }
  s.count = count;
  s.block = block;
  s.body = &body;
  s.error = nullptr;
  s.longest = 0;
  s.busy = static_cast<std::uint32_t>(s.threads.size());
  s.news += 4;
  os::wake_all(s.news);
  const double seconds = s.work(0, s.threads.size() + 1);
  while (const std::uint32_t others = s.busy) os::wait_for_change(s.busy, others);
  s.cost.caller += seconds;
  s.cost.longest += std::max(seconds, s.longest);
  s.cost.wall += wall_seconds() - begun;
  if (s.error) std::rethrow_exception(s.error);
}

void for_blocks(std::size_t count, const std::function<void(std::size_t, std::size_t)>& body,
                std::size_t block) {
  WorkerPool(count > block ? 0 : 1).for_blocks(count, block, body);
}

}  // namespace viete::base
