// Filters of file dialogs, and preferences.
#include "program/small_scene.h"
#include "ui/widgets.h"

using namespace viete;
using test::Driver;

TEST_CASE("typing_in_a_file_list_filters_the_list") {
  test::SmallScene scene;
  Driver& d = scene.d;
  workspace::FileBrowser& browser = d.workspace().files.browser;
  for (const char* dialog : {"open_cage", "save_model"}) {
    CAPTURE(dialog);
    d.run(dialog);
    REQUIRE(ui::is_popup_open());
    d.click("file_list");  // the fields lose the focus
    d.type("ca");
    d.type("ge");
    CHECK(browser.filter == "cage");
    REQUIRE(workspace::shown(browser).size() == 1);
    d.type("\xC3\xA9x");
    CHECK(workspace::shown(browser).empty());
    const std::string name = browser.path;
    d.press_key(workspace::Key::enter);  // must not save under the proposed name
    CHECK(browser.open);
    CHECK(std::filesystem::exists(name) == !browser.saves());
    for (int i = 0; i < 2; ++i) d.press_key(workspace::Key::backspace);
    CHECK(browser.filter == "cage");
    for (int i = 0; i < 4; ++i) d.press_key(workspace::Key::backspace);
    CHECK(browser.filter.empty());
    CHECK(browser.folder == std::filesystem::weakly_canonical(scene.folder.path()));
    d.press_key(workspace::Key::escape);
  }
}

TEST_CASE("a_wrong_path_in_the_filter_is_reported_below_the_filter_and_the_path_row_stays") {
  test::SmallScene scene;
  Driver& d = scene.d;
  const workspace::FileBrowser& browser = d.workspace().files.browser;
  d.run("open_cage");
  d.click("file_list");  // the fields lose the focus
  const std::string path = browser.path;
  d.type("/no/such.obj");
  d.press_key(workspace::Key::enter);
  d.frame(2);
  CHECK(d.viewer().recorder().find("filter_problem"));
  CHECK_FALSE(d.viewer().recorder().find("file_problem"));
  CHECK(browser.path == path);
  CHECK(browser.filter == "/no/such.obj");
  d.type("x");
  d.frame(2);
  CHECK(browser.filter_problem.empty());
  d.press_key(workspace::Key::escape);
}

TEST_CASE("another_scale_applies_at_the_next_frame") {
  Driver d;
  d.frame(3);
  d.viewer().resize({1280, 800}, 2);
  d.frame();
  CHECK(ImGui::GetIO().FontGlobalScale == 0.5f);
  CHECK(ImGui::GetIO().DisplayFramebufferScale.x == 2);
  CHECK(d.viewer().device_size() == glm::ivec2(2560, 1600));
}

TEST_CASE("preferences_change_scale_motion_autosave_and_list_recovered_edits") {
  const test::TemporaryFolder folder;
  Driver d;
  workspace::Workspace& w = d.workspace();
  w.recovery.files = {{folder / "a.viete", "first.obj", 1000, folder.path()},
                      {folder / "b.viete", "second.obj", 500, folder.path(), true}};  // restored once
  d.run("preferences");
  d.choose("preferences/scale", "preferences/scale/3");
  CHECK(w.preferences.scale == 1.5f);
  d.choose("preferences/scale", "preferences/scale/0");
  CHECK_FALSE(w.preferences.scale);
  d.choose("preferences/motion", "preferences/motion/2");
  CHECK(w.preferences.coarse_motion == false);
  d.click("preferences/autosave");
  CHECK_FALSE(w.preferences.autosave);
  d.click("preferences/restore/1");
  CHECK_FALSE(w.panels.show_preferences);
  d.settle();
  REQUIRE_FALSE(w.messages.all().empty());
  CHECK(w.messages.all().back().text.find("b.viete") != std::string::npos);  // this file is missing
}
