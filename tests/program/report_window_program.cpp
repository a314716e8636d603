#include "formats/write.h"
#include "program/driver.h"
#include "support/folder.h"
#include "support/shapes.h"

using namespace viete;
using test::Driver;
namespace fs = std::filesystem;

TEST_CASE("a_report_is_measured_in_the_background_cancelled_and_opened_in_the_browser") {
  const test::TemporaryFolder scratch;
  test::put_file(scratch / "xdg-open", "#!/bin/sh\necho \"$1\" >> " + (scratch / "opened").string() + "\n");
  fs::permissions(scratch / "xdg-open", fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  setenv("PATH", (scratch.path().string() + ":" + path).c_str(), 1);
  app::ViewerOptions options = Driver::default_options();
  options.program = scratch / "viete";  // measures a small model instead of the bundled one
  auto cube = test::moved(test::cube(), 1.5);
  formats::write(scratch / "ball.obj", test::sphere(3));
  formats::write(scratch / "box.obj", cube);
  for (auto& p : cube.positions) p[2] *= 2;
  formats::write(scratch / "pose_tall.obj", cube);
  test::put_file(options.program, "#!/bin/sh\ncd '" + scratch.path().string() + "'\nexec '" +
                                      (test::build_dir() / "viete").string() +
                                      "' \"$@\" ball.obj box.obj pose_tall.obj\n");
  fs::permissions(options.program, fs::perms::owner_all);
  options.state = scratch / "state";
  Driver d(options);
  d.frame(3);
  d.click("show_report");
  REQUIRE(d.workspace().jobs.reporting.running);
  d.click("stop_report");  // after this click, no message is shown
  REQUIRE(d.until([&] { return !d.workspace().jobs.reporting.running; }));
  CHECK(d.workspace().messages.all().empty());
  CHECK(workspace::find_command("show_report")->enabled(d.workspace()));
  d.click("show_report");
  CHECK(d.workspace().jobs.reporting.running);
  REQUIRE(d.until([&] { return !d.workspace().jobs.reporting.running; }));
  setenv("PATH", path.c_str(), 1);
  REQUIRE(d.workspace().messages.all().size() == 1);
  const std::string message = d.workspace().messages.all().back().text,
                    begin = "Opened the report in the browser: ";
  REQUIRE_MESSAGE(message.starts_with(begin), message);
  const std::string page = message.substr(begin.size());
  CHECK(page == (scratch / "state/report/index.html").string());
  CHECK(test::file_bytes(page).ends_with("</html>\n"));
  const std::string opened = "--version\n" + page + "\n";  // written by the script xdg-open
  CHECK(d.until([&] { return test::file_bytes(scratch / "opened") == opened; }));
}
