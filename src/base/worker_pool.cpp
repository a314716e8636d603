#include "base/worker_pool.h"

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <mutex>

#include "base/clock.h"
#include "base/os.h"

namespace viete::base {

struct WorkerPool::State {
  const unsigned long process = os::process_id();
  std::vector<std::jthread> threads;  // threads[i] has the number i + 1; the caller has the number 0
  std::mutex mutex;
  std::condition_variable wake, finished;
  std::uint64_t generation = 0;
  int busy = 0;
  std::size_t last = 0;  // threads with a higher number must end
  std::exception_ptr error;
  Cost cost;
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
    std::uint64_t seen = 0;
    for (;;) {
      {
        std::unique_lock lock(mutex);
        wake.wait(lock, [&] { return index > last || generation != seen; });
        if (index > last) return;
        seen = generation;
      }
      const double seconds = work(index, threads.size() + 1);
      const std::lock_guard lock(mutex);
      longest = std::max(longest, seconds);
      if (--busy == 0) finished.notify_one();
    }
  }

  // Starts as many threads as the system allows. If the system refuses a thread, ends half of the threads, to
  // leave memory and threads to the rest of the program.
  void start(std::size_t wanted) {
    threads.reserve(wanted);
    {
      const std::lock_guard lock(mutex);  // new threads wait until the list is complete
      while (threads.size() < wanted) {
        std::jthread thread = try_thread([this, index = threads.size() + 1] { serve(index); });
        if (!thread.joinable()) break;
        threads.push_back(std::move(thread));
      }
      last = threads.size() == wanted ? wanted : threads.size() / 2;
    }
    end_beyond_last();
  }

  void end_beyond_last() {
    wake.notify_all();
    threads.resize(last);  // waits until the removed threads end
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
  {
    const std::lock_guard lock(state_->mutex);
    state_->last = 0;
  }
  state_->end_beyond_last();
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
  {
    const std::lock_guard lock(s.mutex);
    s.count = count;
    s.block = block;
    s.body = &body;
    s.error = nullptr;
    s.longest = 0;
    s.busy = static_cast<int>(s.threads.size());
    ++s.generation;
  }
  s.wake.notify_all();
  const double seconds = s.work(0, s.threads.size() + 1);
  std::unique_lock lock(s.mutex);
  s.finished.wait(lock, [&] { return s.busy == 0; });
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
