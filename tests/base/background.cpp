#include <doctest/doctest.h>
#include <vector>

#include "base/background.h"
#include "support/threads_left.h"

TEST_CASE("thread_time_does_not_count_sleep_and_wall_time_does") {
  viete::base::Stopwatch whole, watch;
  const double before = viete::base::thread_seconds();
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  const double worked = 1000 * (viete::base::thread_seconds() - before), first = watch.lap_ms(),
               second = watch.lap_ms();
  CHECK(first >= 29.0);
  CHECK(worked < first - 25);
  CHECK(first + second <= whole.lap_ms());
}

TEST_CASE("sections_join_to_one_whole_until_the_work_is_cancelled") {
  viete::base::Progress progress;
  progress.section(0, 0.5);
  progress.report(1);
  CHECK(progress.done() == 0.5);
  progress.section(0.5, 1);
  progress.report(0.5);
  CHECK(progress.done() == 0.75);
  progress.cancel();
  CHECK_THROWS_AS(progress.report(0.8), viete::base::Cancelled);
  CHECK_THROWS_AS(progress.section(0.8, 1), viete::base::Cancelled);
}

using viete::base::BackgroundJob;
using viete::base::BackgroundQueue;
using viete::base::Progress;

namespace {

// Starts a job that reports progress until it is cancelled.
struct Endless {
  void start(BackgroundJob<int>& job, std::shared_ptr<int> held = nullptr) {
    job.start([this, held](Progress& progress) -> int {
      begun.set_value();
      for (;;) progress.report(held ? 0.5 : 0.25);
    });
    begun.get_future().wait();
  }
  std::promise<void> begun;
};

}  // namespace

TEST_CASE("queue_runs_all_work_in_order_before_it_ends") {
  std::vector<int> done;
  {
    BackgroundQueue queue;
    for (int i = 0; i < 100; ++i) queue.add([&done, i] { done.push_back(i); });
  }
  REQUIRE(done.size() == 100);
  for (int i = 0; i < 100; ++i) CHECK(done[i] == i);
}

TEST_CASE("queue_passes_exceptions_on_and_continues") {
  BackgroundQueue queue;
  auto fails = queue.add([]() -> int { throw std::runtime_error("no disk"); });
  auto works = queue.add([] { return 7; });
  CHECK(works.get() == 7);
  CHECK(viete::base::is_ready(fails));
  CHECK_THROWS_WITH(fails.get(), "no disk");
}

TEST_CASE("job_gives_its_value_or_the_reason_of_its_failure_once") {
  BackgroundJob<int> job;
  CHECK_FALSE(job.running());
  CHECK_FALSE(job.state().running);
  CHECK_FALSE(job.poll(true));
  job.start([](Progress&) { return 42; }, "Counting");
  CHECK(job.state().what == "Counting");
  CHECK(job.running());
  const auto result = job.poll(true);
  REQUIRE(result);
  CHECK(result->value == 42);
  CHECK_FALSE(result->stopped);
  CHECK_FALSE(job.running());
  CHECK_FALSE(job.poll(true));
  job.start([](Progress&) -> int { throw std::runtime_error("too large"); });
  const auto failure = job.poll(true);
  REQUIRE(failure);
  CHECK_FALSE(failure->value);
  CHECK(failure->problem == "too large");
  CHECK_FALSE(failure->stopped);
}

TEST_CASE("a_job_without_memory_fails_with_advice") {
  BackgroundJob<int> job;
  job.start([](viete::base::StepProgress&) -> int { throw std::bad_alloc(); });
  CHECK(job.poll(true)->problem == "not enough memory; close other programs or use a smaller model");
}

TEST_CASE("stopped_job_reports_it") {
  BackgroundJob<int> job;
  Endless endless;
  endless.start(job);
  CHECK_FALSE(job.poll());
  job.stop();
  const auto result = job.poll(true);
  REQUIRE(result);
  CHECK(result->stopped);
  CHECK(result->problem.empty());
  CHECK_FALSE(result->value);
}

TEST_CASE("job_cancelled_before_it_begins_does_not_run") {
  std::atomic<int> done = 0;
  {
    BackgroundJob<int> job;
    Endless endless;
    endless.start(job);
    for (int i = 0; i < 3; ++i) job.start([&](Progress&) { return ++done; });
    CHECK(job.poll(true)->value == 1);
  }
  CHECK(done == 1);
}

TEST_CASE("a_job_frees_its_resources") {
  const auto held = std::make_shared<int>(5);
  BackgroundJob<int> job;
  Endless endless;
  endless.start(job, held);
  CHECK(held.use_count() > 1);
  job.start([](Progress&) { return 0; });
  CHECK(job.poll(true));
  CHECK(held.use_count() == 1);
}

TEST_CASE("without_a_thread_the_caller_runs_the_work") {
  const viete::test::ThreadsLeft limit(0);
  BackgroundJob<int> job;
  job.start([](Progress&) { return 7; });
  CHECK(job.has_result());
  CHECK(job.poll()->value == 7);
  job.start([](Progress&) -> int { throw std::runtime_error("no disk"); });
  CHECK(job.poll()->problem == "no disk");
}
