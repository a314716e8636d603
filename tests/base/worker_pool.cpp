#include "base/worker_pool.h"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <stdexcept>

#include "support/threads_left.h"

using viete::base::WorkerPool;

namespace {

int visited_by(WorkerPool& pool) {
  std::atomic<int> sum{0};
  pool.for_blocks(100, 3, [&](std::size_t begin, std::size_t end) { sum += static_cast<int>(end - begin); });
  return sum;
}

rlim_t address_space() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace

TEST_CASE("every_element_is_visited_once_for_any_count_block_and_thread_number") {
  for (const int threads : {1, 2, 3, 7}) {
    WorkerPool pool(threads);
    CHECK(pool.threads() == threads);
    for (const std::size_t count : {0u, 1u, 2u, 63u, 64u, 65u, 1000u})
      for (const std::size_t block : {1u, 7u, 64u, 5000u}) {
        std::vector<std::atomic<int>> visits(count);
        pool.for_blocks(count, block, [&](std::size_t begin, std::size_t end) {
          CHECK_MESSAGE(begin % block == 0, "blocks do not depend on the number of threads");
          for (std::size_t i = begin; i < end; ++i) ++visits[i];
        });
        for (const auto& v : visits) REQUIRE(v == 1);
      }
  }
}

TEST_CASE("an_exception_reaches_the_caller_and_the_pool_lives_on") {
  WorkerPool pool(3);
  CHECK_THROWS_AS(pool.for_blocks(100, 1,
                                  [](std::size_t begin, std::size_t) {
                                    if (begin == 99) throw std::runtime_error("no");
                                  }),
                  std::runtime_error);
  CHECK(visited_by(pool) == 100);
}

TEST_CASE("in_a_child_of_fork_the_caller_runs_all_blocks") {
  auto pool = std::make_unique<WorkerPool>(3);
  const pid_t child = fork();
  if (child == 0) {
    const int sum = visited_by(*pool);
    pool.reset();
    _exit(sum == 100 ? 0 : 1);
  }
  int status = -1;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(status == 0);
}

TEST_CASE("pool_works_with_the_threads_that_the_system_allows") {
  for (int left = 0; left < 7; ++left) {
    const viete::test::ThreadsLeft limit(left);
    WorkerPool pool(8);
    CHECK(pool.threads() == 1 + left / 2);  // the pool keeps half of the threads that it could start
    CHECK(visited_by(pool) == 100);
  }
  WorkerPool all(8);
  CHECK(all.threads() == 8);
}

TEST_CASE("a_pool_without_all_threads_ends_without_a_loop") {
  for (int i = 0; i < 1000; ++i) {
    const viete::test::ThreadsLeft limit(6);
    WorkerPool pool(8);
    CHECK(pool.threads() == 4);
  }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // the sanitizers need more address space
TEST_CASE("pool_leaves_address_space_to_its_caller") {
  const pid_t child = fork();
  if (child == 0) {
    const rlim_t most = address_space() + (512u << 20);
    const rlimit limit{most, most};
    if (setrlimit(RLIMIT_AS, &limit) != 0) _exit(2);
    WorkerPool pool(600);
    const std::vector<char> more(100u << 20);
    _exit(pool.threads() < 600 && visited_by(pool) == 100 && more.back() == 0 ? 0 : 1);
  }
  int status = -1;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(status == 0);
}
#endif

TEST_CASE("the_cost_of_loops_is_the_callers_and_the_longest") {
  WorkerPool pool(2);
  CHECK(pool.cost().longest == 0);
  std::atomic<long> sum{0};
  pool.for_blocks(2, 1, [&](std::size_t begin, std::size_t) {
    for (int i = 0; i < (begin == 0 ? 1'000 : 3'000'000); ++i) sum += i;
  });
  CHECK(pool.cost().caller > 0);
  CHECK(pool.cost().longest > pool.cost().caller);  // the second block ran on the other thread
}
