#include "base/progress.h"

#include <doctest/doctest.h>

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
