#include <doctest/doctest.h>
#include <atomic>
#include <future>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/background.h"
#include "base/clock.h"
#include "base/progress.h"
#include "support/threads_left.h"

TEST_CASE("thread_time_does_not_count_sleep_and_wall_time_does") {
  viete::base::Stopwatch watch;
  const double before = viete::base::thread_seconds();
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  const double worked_ms = 1000 * (viete::base::thread_seconds() - before), passed_ms = watch.lap_ms();
  CHECK(passed_ms >= 29.0);
  CHECK(worked_ms < passed_ms - 25);
}

TEST_CASE("a_lap_starts_the_next_one") {
  viete::base::Stopwatch whole, watch;
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const double first = watch.lap_ms(), second = watch.lap_ms();
  CHECK(first >= 19.0);
  CHECK(first + second <= whole.lap_ms());
}

TEST_CASE("cancelling_stops_the_work_at_its_next_report") {
  viete::base::Progress progress;
  progress.report(0.25);
  CHECK(progress.done() == 0.25);
  progress.cancel();
  CHECK_THROWS_AS(progress.report(0.5), viete::base::Cancelled);
}

TEST_CASE("sections_join_to_one_whole") {
  viete::base::Progress progress;
  progress.section(0, 0.5);
  progress.report(1);
  CHECK(progress.done() == 0.5);
  progress.section(0.5, 1);
  progress.report(0.5);
  CHECK(progress.done() == 0.75);
  progress.cancel();
  CHECK_THROWS_AS(progress.section(0.8, 1), viete::base::Cancelled);
}

using viete::base::BackgroundJob;
using viete::base::BackgroundQueue;
using viete::base::Progress;

namespace {

// Reports progress until it is cancelled.
int endless(Progress& progress, std::promise<void>& begun) {
  begun.set_value();
  for (;;) progress.report(0.5);
}

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

TEST_CASE("job_gives_its_value_once") {
  BackgroundJob<int> job;
  CHECK_FALSE(job.running());
  CHECK_FALSE(job.poll(true));
  job.start([](Progress&) { return 42; });
  CHECK(job.running());
  const auto result = job.poll(true);
  REQUIRE(result);
  CHECK(result->value == 42);
  CHECK_FALSE(result->stopped);
  CHECK_FALSE(job.running());
  CHECK_FALSE(job.poll(true));
}

TEST_CASE("failed_job_reports_the_reason") {
  BackgroundJob<int> job;
  job.start([](Progress&) -> int { throw std::runtime_error("too large"); });
  const auto result = job.poll(true);
  REQUIRE(result);
  CHECK_FALSE(result->value);
  CHECK(result->problem == "too large");
  CHECK_FALSE(result->stopped);
}

TEST_CASE("stopped_job_reports_it") {
  BackgroundJob<int> job;
  std::promise<void> begun;
  job.start([&](Progress& progress) { return endless(progress, begun); });
  begun.get_future().wait();
  CHECK_FALSE(job.poll());
  job.stop();
  const auto result = job.poll(true);
  REQUIRE(result);
  CHECK(result->stopped);
  CHECK(result->problem.empty());
  CHECK_FALSE(result->value);
}

TEST_CASE("a_new_job_replaces_the_running_one") {
  BackgroundJob<int> job;
  std::promise<void> begun;
  job.start([&](Progress& progress) { return endless(progress, begun); });
  begun.get_future().wait();
  job.start([](Progress&) { return 2; });
  const auto result = job.poll(true);
  REQUIRE(result);
  CHECK(result->value == 2);
}

TEST_CASE("job_cancelled_before_it_begins_does_not_run") {
  std::atomic<int> done = 0;
  {
    BackgroundJob<int> job;
    std::promise<void> begun;
    job.start([&](Progress& progress) { return endless(progress, begun); });
    begun.get_future().wait();
    for (int i = 0; i < 3; ++i) job.start([&](Progress&) { return ++done; });
    CHECK(job.poll(true)->value == 1);
  }
  CHECK(done == 1);
}

TEST_CASE("a_job_frees_its_resources") {
  const auto held = std::make_shared<int>(5);
  BackgroundJob<int> job;
  std::promise<void> begun;
  job.start([&, held](Progress& progress) { return *held + endless(progress, begun); });
  begun.get_future().wait();
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
