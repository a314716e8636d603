// The benchmark beside the view: measured aside, drawn, cancelled.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "base/clock.h"
#include "program/driver.h"
#include "support/folder.h"

using namespace viete;
using test::Driver;
namespace fs = std::filesystem;

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

TEST_CASE("a_report_is_measured_aside_and_opened_in_the_browser") {
  const test::TemporaryFolder scratch;
  test::put_file(scratch / "xdg-open", "#!/bin/sh\necho \"$1\" >> " + (scratch / "opened").string() + "\n");
  fs::permissions(scratch / "xdg-open", fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  setenv("PATH", (scratch.path().string() + ":" + path).c_str(), 1);
  app::ViewerOptions options = Driver::default_options();
  options.program = test::build_dir() / "viete";
  options.state = scratch / "state";
  Driver d(options);
  d.frame(3);
  d.click("section/Benchmark");
  d.click("show_report");
  d.frame();
  CHECK(d.workspace().benchmark.running);
  REQUIRE(frames_to_end(d, [&] { return !d.workspace().benchmark.running; }));
  setenv("PATH", path.c_str(), 1);
  REQUIRE(d.workspace().messages.all().size() == 1);
  const std::string message = d.workspace().messages.all().back().text,
                    begin = "The report is open in the browser: ";
  REQUIRE_MESSAGE(message.starts_with(begin), message);
  const std::string page = message.substr(begin.size());
  CHECK(page == (scratch / "state/report/index.html").string());
  CHECK(test::file_bytes(page).ends_with("</html>\n"));
  for (int n = 0; n < 100 && test::file_bytes(scratch / "opened").find(page) == std::string::npos; ++n)
    usleep(50'000);
  CHECK(test::file_bytes(scratch / "opened") == "--version\n" + page + "\n");
}

TEST_CASE("a_program_that_is_left_while_it_measures_ends") {
  Driver driver;
  CHECK(with_open_section(driver).workspace().benchmark.running);
}
