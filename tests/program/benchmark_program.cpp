// The benchmark beside the view: measured aside, drawn, cancelled.
#include "base/clock.h"
#include "program/driver.h"

using namespace viete;
using test::Driver;

namespace {

template <class Condition>
bool frames_to_end(Driver& d, Condition condition) {
  const double deadline = base::wall_seconds() + 600;
  while (!condition()) {
    if (base::wall_seconds() > deadline) return false;
    d.frame();
  }
  return true;
}

Driver& with_open_section(Driver& d) {
  d.frame(3);
  d.click("section/Benchmark");
  d.click("run_benchmark");
  d.frame();
  return d;
}

}  // namespace

TEST_CASE("the_benchmark_runs_beside_the_view_and_draws_every_method") {
  Driver driver;
  Driver& d = with_open_section(driver);
  CHECK(d.workspace().benchmark.running);
  REQUIRE(frames_to_end(d, [&] { return !d.workspace().benchmark.running; }));
  const auto& bench = d.workspace().benchmark;
  REQUIRE(bench.bars.size() == 6);
  CHECK(bench.bars[0].name == "Diag");
  for (const auto& bar : bench.bars) CHECK_MESSAGE(bar.ns > 0, bar.name);
  CHECK(bench.bars[3].ours);
  CHECK(bench.count == 1 << 18);
}

TEST_CASE("a_cancelled_benchmark_stops_and_shows_nothing") {
  Driver driver;
  Driver& d = with_open_section(driver);
  REQUIRE(d.workspace().benchmark.running);
  d.click("stop_benchmark");
  REQUIRE(frames_to_end(d, [&] { return !d.workspace().benchmark.running; }));
  CHECK(d.workspace().benchmark.bars.empty());
  CHECK(d.workspace().messages.all().empty());
  CHECK(scene::find_command("run_benchmark")->enabled(d.workspace()));
}

TEST_CASE("a_program_that_is_left_while_it_measures_ends") {
  Driver driver;
  CHECK(with_open_section(driver).workspace().benchmark.running);
}
