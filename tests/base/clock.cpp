#include "base/clock.h"

#include <doctest/doctest.h>

#include <thread>

TEST_CASE("thread_time_does_not_count_sleep_and_wall_time_does") {
  viete::base::Stopwatch watch;
  const double before = viete::base::thread_seconds();
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  CHECK(watch.lap_ms() >= 29.0);
  CHECK(viete::base::thread_seconds() - before < 0.02);
}

TEST_CASE("a_lap_starts_the_next_one") {
  viete::base::Stopwatch watch;
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  watch.lap_ms();
  CHECK(watch.lap_ms() < 19.0);
}
