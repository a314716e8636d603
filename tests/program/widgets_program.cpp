// Clicks in file dialogs, measured methods and marked folds.
#include "document/pose_edit.h"
#include "program/driver.h"
#include "support/folder.h"
#include "support/pictures.h"

using namespace viete;
using test::Dragon, test::Driver;
namespace fs = std::filesystem;

TEST_CASE("in_a_file_dialog_a_click_selects_and_two_open") {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "inner");
  fs::copy_file(test::dragon_cage, folder / "inner" / "cage.obj");
  fs::copy_file(test::dragon_cage, folder / "other.obj");
  Driver d;
  REQUIRE(d.open({test::dragon}));
  d.settle();
  d.frame(30);
  workspace::FileBrowser& browser = d.workspace().files.browser;
  workspace::show(browser, workspace::FileBrowser::Purpose::cage, folder.path());
  d.frame(3);
  d.click("file/inner");
  d.frame(30);
  CHECK(browser.folder == fs::weakly_canonical(folder.path()));
  CHECK(browser.path == browser.folder / "inner");
  for (int i = 0; i < 2; ++i) d.click("file/inner");
  d.frame(30);
  CHECK(browser.folder.filename() == "inner");
  d.click("file/cage.obj");
  d.frame(30);
  CHECK(browser.open);
  CHECK_FALSE(d.document().has_cage());
  SUBCASE("two clicks") {
    for (int i = 0; i < 2; ++i) d.click("file/cage.obj");
  }
  SUBCASE("enter") {
    d.press_key(workspace::Key::enter);
  }
  SUBCASE("the button") {
    d.click("file_choose");
  }
  d.settle();
  CHECK_FALSE(browser.open);
  CHECK(d.document().has_cage());
}

TEST_CASE("a_file_is_replaced_by_a_second_enter_and_not_by_two_clicks") {
  const test::TemporaryFolder folder;
  const std::string precious = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  test::put_file(folder / "precious.obj", precious);
  Dragon d;
  workspace::FileBrowser& browser = d.workspace().files.browser;
  workspace::show(browser, workspace::FileBrowser::Purpose::save_model, folder.path(), "new.obj");
  d.frame(30);
  for (int i = 0; i < 2; ++i) d.click("file/precious.obj");
  d.frame(3);
  CHECK(browser.open);
  CHECK(browser.path == browser.folder / "precious.obj");
  CHECK(d.recorder().find("file_replaces"));
  d.press_key(workspace::Key::enter);  // the first Enter warns; the second Enter confirms
  CHECK(browser.open);
  CHECK(test::file_bytes(folder / "precious.obj") == precious);
  d.press_key(workspace::Key::enter);
  d.settle();
  CHECK_FALSE(browser.open);
  CHECK(fs::file_size(folder / "precious.obj") > 1000);
}

TEST_CASE("every_method_is_timed_in_the_background_when_the_pose_rests_and_none_during_a_drag") {
  auto options = Driver::default_options({1440, 900});
  options.probe = true;
  Driver d(options);
  d.open_dragon("pose_alert");
  const auto& times = d.workspace().frame.method_times;
  REQUIRE(d.until([&] { return times.measured; }));
  constexpr std::size_t fused = workspace::MethodTimes::fused;
  for (std::size_t method = 0; method < fused; ++method) {
    CHECK(times.stages[method][pose::Stage::exp] > 0);
    CHECK(times.stages[method][pose::Stage::fused] == 0);
  }
  CHECK(times.stages[fused][pose::Stage::fused] > 0);
  CHECK(times.fused_error > 0);
  CHECK(times.fused_error < 1e-4);
  CHECK(d.recorder().find("timings/fused"));
  // If the method changes, no new binding is needed.
  d.click("method_diag");
  REQUIRE(d.until([&] { return d.viewer().deformer()->ran() == pose::EngineKind::staged; }));

  d.workspace().frame.method_times = {};
  const glm::vec2 at = glm::round(d.vertex(d.free_vertex()));
  d.press_and_move(at, at + glm::vec2(40, 20));
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(1);
  while (std::chrono::steady_clock::now() < end) {
    d.frame();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  CHECK_FALSE(times.measured);
  d.button(0, false);
  CHECK(d.until([&] { return times.measured; }));

  d.run("deformer_mean_value");  // without exponentials: only the fused engine is timed
  CHECK(d.until(
      [&] { return times.measured && times.stages[fused].total() > 0 && times.stages[0].total() == 0; }));
}

TEST_CASE("possible_folds_are_listed_in_the_checks_and_marked_on_the_cage") {
  Driver d(Driver::default_options({1440, 900}), test::with_pixels);
  d.open_dragon();
  d.workspace().preferences.layout.sections["Checks"] = true;
  d.settle();
  d.move({720, 880});
  CHECK_FALSE(d.recorder().find("pose_note/0"));
  const double middle =
      d.document().cage_file().bounds.low[0] +
      0.7 * (d.document().cage_file().bounds.high[0] - d.document().cage_file().bounds.low[0]);
  pose::Pose pose = d.document().pose();
  for (auto& p : pose.positions)
    if (p[0] > middle) p = {p[0], -p[1], -p[2]};
  document::set_pose(d.document(), pose);
  d.settle();
  REQUIRE_FALSE(d.workspace().frame.report.torn.empty());
  CHECK(d.recorder().find("pose_note/0"));
  CHECK(d.workspace().messages.all().empty());
  const auto with = d.picture();
  d.workspace().frame.report.torn.clear();
  d.frame();
  CHECK(test::difference(with, d.picture(), 0) > 0);  // the marks are visible
  document::reset_pose(d.document());
  d.settle();
  CHECK_FALSE(d.recorder().find("pose_note/0"));
}
