// File dialogs, preferences, menus of files and toasts, by mouse and keys.
#include "formats/read.h"
#include "formats/write.h"
#include "program/kept_work.h"
#include "program/small_scene.h"
#include "ui/widgets.h"
#include "workspace/open_save.h"
#include "workspace/preferences.h"

using namespace viete;
using test::Dragon, test::Driver, test::remembering;
namespace fs = std::filesystem;

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

namespace {

void open_cube(Driver& d, const std::filesystem::path& folder) {
  mesh::Surface cage = formats::read(test::dragon_cage).surface;
  formats::write(folder / "cube.obj", cage);
  REQUIRE(d.open({folder / "cube.obj"}));
  d.frame(3);
}

// Types a path in the file browser. Waits until the program has read, written or refused the file.
void ask_for(Driver& d, const char* command, const std::filesystem::path& file) {
  workspace::find_command(command)->run(d.workspace());
  d.frame(3);
  REQUIRE(d.workspace().files.browser.open);
  d.type(file.string());
  d.press_key(workspace::Key::enter);
  if (d.workspace().files.browser.warned == file.string())
    d.press_key(workspace::Key::enter);  // overwrites the file
  REQUIRE(d.until([&] { return d.workspace().files.browser.asked.empty() && !d.viewer().exporting(); }));
  d.frame(2);
}

void check_refused(Driver& d, const std::filesystem::path& file) {
  const auto& browser = d.workspace().files.browser;
  CHECK(browser.open);
  CHECK(browser.path == file);
  REQUIRE(d.recorder().find("file_problem"));
  CHECK(d.recorder().find("file_problem")->y0 >= d.recorder().find("file_path")->y1);
  CHECK(browser.problem.find("--") == std::string::npos);
  CHECK_FALSE(browser.problem.starts_with(file.string() + ": "));
  CHECK_MESSAGE(d.workspace().messages.all().empty(), browser.problem);
  d.press_key(workspace::Key::escape);
  CHECK_FALSE(browser.open);
}

}  // namespace

TEST_CASE("columns_sections_theme_and_recent_files_are_as_they_were_left") {
  const test::TemporaryFolder folder;
  {
    Driver d(remembering(folder / "state"));
    d.open_dragon();
    d.click("section/Map");
    d.click("tab/methods");
    d.press_key(workspace::key('T'));
    d.workspace().jobs.wishes.add(workspace::CloseProgram{});
    d.frame(2);
  }
  Driver d(remembering(folder / "state"));
  d.frame(3);
  d.click("recent/0");
  d.settle();
  CHECK(d.document().model().path == test::dragon);
  CHECK(d.document().cage_file().path == test::dragon_cage);
  CHECK_FALSE(d.workspace().view.options.dark);
  CHECK_FALSE(d.recorder().find("method_diag"));
  d.click("tab/methods");
  CHECK(d.recorder().find("map"));
}

TEST_CASE("the_menus_name_what_is_undone_and_list_edits_and_recent_files") {
  const test::TemporaryFolder folder;
  Driver d;
  open_cube(d, folder.path());
  d.open_dragon();
  for (int i = 1; i <= 60; ++i) {
    document::record_edit(d.document(), "rotate " + std::to_string(i));
    d.document().changed_pose().positions[0][0] += 0.001;
  }
  const auto menu = [&](const char* title, const char* list) {
    for (const char* name : {title, list}) {
      const auto rect = d.recorder().find(std::string("menu/") + name);
      REQUIRE(rect);
      d.click(glm::vec2(0.5f * (rect->x0 + rect->x1), 0.5f * (rect->y0 + rect->y1)));
    }
  };
  menu("Edit", "history");
  const auto& recorder = d.recorder();
  CHECK(recorder.find("history/60"));
  CHECK(recorder.find("history/10"));
  CHECK_FALSE(recorder.find("history/9"));
  d.click("history/45");
  CHECK(d.document().history().position() == 45);
  CHECK(workspace::find_command("undo")->label_now(d.workspace()) == "Undo Rotate 45");
  workspace::mark_saved(d.workspace());
  menu("File", "recent");
  const auto file = d.workspace().preferences.recent.at(1).file;
  d.click("menu/recent/1");
  d.settle();
  CHECK(d.document().model().path == file);
}

TEST_CASE("an_error_is_shown_until_it_is_dismissed") {
  const test::TemporaryFolder folder;
  Dragon d;
  CHECK_FALSE(d.open({folder / "none.ply"}));
  d.frame(2);
  CHECK(d.is_seen("toast/0"));
  SUBCASE("it is put away") {
    d.click("toast/0/close");
    CHECK_FALSE(d.recorder().find("toast/0"));
  }
  SUBCASE("a click shows the list") {
    d.click("toast/0");
    CHECK(d.is_seen("message/0"));
    d.click("clear_messages");
    CHECK(d.workspace().messages.all().empty());
    d.press_key(workspace::Key::escape);
    CHECK_FALSE(d.workspace().panels.show_messages);
  }
}

TEST_CASE("in_a_save_dialog_typing_replaces_the_name_a_button_its_format_and_unknown_formats_are_refused") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "a_folder");
  Dragon d;
  d.workspace().files.saved.session = folder / "session.viete";  // exports suggest the folder of the session
  for (const char* name : {"first.obj", "second.obj"}) {
    d.press_key(workspace::key('P'), true, true);
    d.type((folder / name).string());
    d.press_key(workspace::Key::enter);
    CHECK(std::filesystem::exists(folder / name));
  }
  d.press_key(workspace::key('E'), true);
  d.type("arm.xyz");
  d.press_key(workspace::Key::enter);
  CHECK(d.workspace().files.browser.open);
  CHECK(d.workspace().files.browser.path == "arm.xyz");
  CHECK(d.recorder().find("file_problem"));
  d.click("format_ply");
  d.press_key(workspace::Key::enter);
  CHECK_FALSE(d.workspace().files.browser.open);
  d.viewer().finish_exports();
  CHECK(std::filesystem::exists(folder / "arm.ply"));
}

TEST_CASE("a_refused_or_failed_file_keeps_its_dialog_with_the_path_and_the_reason_below") {
  const test::TemporaryFolder folder;
  Driver d;
  open_cube(d, folder.path());
  REQUIRE(d.open({folder / "cube.obj", test::dragon_cage}));
  d.press_key(workspace::key('A'));
  workspace::find_command("keep_pose")->run(d.workspace());
  workspace::find_command("set_key")->run(d.workspace());
  d.frame(3);
  d.workspace().messages.clear();
  const auto top = std::filesystem::canonical(folder.path());
  test::put_file(top / "broken.obj", "v 0 0\nf 1 2 3\n");
  test::put_file(top / "text.viete", "a text");
  test::put_file(top / "f_01.obj", "somebody else's");
  const std::string too_long(300, 'x');
  for (const char* command :
       {"open_model", "open_cage", "open_pose", "import_poses", "import_shapes", "import_animation"}) {
    CAPTURE(command);
    ask_for(d, command, top / "broken.obj");
    check_refused(d, top / "broken.obj");
  }
  for (const char* command : {"save_pose", "save_cage", "save_model"}) {
    CAPTURE(command);
    ask_for(d, command, top / (too_long + ".obj"));
    check_refused(d, top / (too_long + ".obj"));
  }
  ask_for(d, "save_session_as", top / "text.viete");
  check_refused(d, top / "text.viete");
  CHECK(test::file_bytes(top / "text.viete") == "a text");
  d.run("save_animation");
  d.type((top / "f_##.obj").string());
  d.press_key(workspace::Key::enter);  // asks before it exports
  CHECK_FALSE(d.workspace().jobs.exporting.running);
  CHECK(d.workspace().files.browser.open);
  CHECK(d.recorder().find("file_replaces"));
  CHECK(test::file_bytes(top / "f_01.obj") == "somebody else's");
  d.press_key(workspace::Key::enter);
  REQUIRE(d.until([&] { return !d.viewer().exporting(); }));
  CHECK_FALSE(d.workspace().files.browser.open);
  CHECK(test::file_bytes(top / "f_01.obj") != "somebody else's");
  d.workspace().messages.clear();
  {
    const test::FullDisk full(100);
    ask_for(d, "save_model", top / "out.obj");
  }
  check_refused(d, top / "out.obj");
  ask_for(d, "save_model", top / "out.obj");
  CHECK_FALSE(d.workspace().files.browser.open);
  CHECK(std::filesystem::exists(top / "out.obj"));
}
