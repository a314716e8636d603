#include "base/clock.h"

#include <doctest/doctest.h>

#include <thread>

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
