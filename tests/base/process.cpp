#include <atomic>
#include <thread>

#include "base/process.h"
#include "support/zombie.h"

using namespace viete::base;

TEST_CASE("this_process_runs_and_its_number_with_another_start_does_not") {
  const std::string name = process_name();
  CHECK(name.starts_with(std::to_string(getpid()) + "-"));
  CHECK(process_runs(name));
  CHECK_FALSE(process_runs(name + "0"));
  CHECK_FALSE(process_runs(std::to_string(getpid())));
}

TEST_CASE("ended_processes_do_not_run_even_as_zombies") {
  viete::test::Zombie zombie;
  CHECK_FALSE(process_runs(zombie.name));
  zombie.bury();
  CHECK_FALSE(process_runs(zombie.name));
}

TEST_CASE("invalid_process_names_do_not_run") {
  for (const char* name : {"", "-", "abc", "12x-5", "../self-1", "99999999999999999999-1"})
    CHECK_FALSE_MESSAGE(process_runs(name), name);
}

using viete::base::ForkDelay;

TEST_CASE("fork_waits_for_other_threads_and_not_for_its_own") {
  std::atomic<bool> begun = false, stop = false;
  std::atomic<int> half = 0;  // odd while the other thread has a ForkDelay
  std::jthread other([&] {
    while (!stop) {
      const ForkDelay delay;
      ++half;
      begun = true;
      begun.notify_all();
      for (int i = 0; i < 10'000; ++i) half.load();
      ++half;
    }
  });
  begun.wait(false);
  for (int i = 0; i < 50; ++i) {
    const ForkDelay own, nested;
    const pid_t child = fork();
    if (child == 0) {
      alarm(60);  // ends the child if it hangs
      const ForkDelay inside_child;
      _exit(half % 2);
    }
    int status = -1;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(status == 0);
  }
  stop = true;
}
