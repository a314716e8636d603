#include "base/process.h"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <thread>

using viete::base::ForkDelay;

TEST_CASE("fork_waits_for_other_threads_and_not_for_its_own") {
  std::atomic<bool> begun = false, stop = false;
  std::atomic<int> half = 0;  // odd while the other thread is inside
  std::jthread other([&] {
    while (!stop) {
      const ForkDelay delay;
      ++half;
      begun = true, begun.notify_all();
      for (int i = 0; i < 10'000; ++i) half.load();
      ++half;
    }
  });
  begun.wait(false);
  for (int i = 0; i < 50; ++i) {
    const ForkDelay own, nested;
    const pid_t child = fork();
    if (child == 0) {
      alarm(60);  // only against a hang
      const ForkDelay inside_child;
      _exit(half % 2);
    }
    int status = -1;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(status == 0);
  }
  stop = true;
}
