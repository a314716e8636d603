#include "bench/rounds.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "bench/table.h"

using namespace viete;

TEST_CASE("every_case_runs_once_a_round_in_turn_and_once_before") {
  std::string order;
  base::Progress progress;
  const auto results = bench::measure_rounds(
      {{"a", 1, [&](std::size_t) { order += 'a'; }}, {"b", 10, [&](std::size_t) { order += 'b'; }}}, 3,
      progress);
  CHECK(order == "abababab");
  REQUIRE(results.size() == 2);
  CHECK(results[0].name == "a");
  CHECK(results[1].name == "b");
  CHECK(progress.done() == 1);
}

TEST_CASE("rounds_can_be_cancelled") {
  base::Progress progress;
  std::size_t runs = 0;
  const auto run = [&](std::size_t) {
    if (++runs == 2) progress.cancel();
  };
  CHECK_THROWS_AS(bench::measure_rounds({{"a", 1, run}}, 100, progress), base::Cancelled);
  CHECK(runs == 2);
}

TEST_CASE("a_time_is_found_by_its_name") {
  const std::vector<bench::BenchResult> results = {{"fast", 3}, {"diag", 500}};
  CHECK(bench::time_of(results, "diag") == 500);
  CHECK(bench::time_of(results, "none") == 0);
  CHECK(bench::to_json(results)[0]["ns"] == 3);
}

TEST_CASE("a_bar_is_met_from_above_or_from_below") {
  bench::Bars bars;
  bars.check("as fast", 5, 5, true);
  bars.check("too slow", 4.9, 5, true);
  bars.check("small enough", 4.9, 5, false);
  REQUIRE(bars.rows.size() == 3);
  CHECK(bars.rows[0]["met"] == true);
  CHECK(bars.rows[1]["met"] == false);
  CHECK(bars.rows[2]["met"] == true);
}
