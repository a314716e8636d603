// Uses columns, menus, toasts and the palette by mouse and keys.
#include <map>

#include "document/record.h"
#include "formats/read.h"
#include "formats/write.h"
#include "program/kept_work.h"
#include "support/folder.h"
#include "support/pictures.h"
#include "workspace/menus.h"
#include "workspace/preferences.h"
#include "workspace/saving.h"

using namespace viete;
using test::Driver, test::remembering;

namespace {

bool is_seen(Driver& d, const std::string& widget) {
  const auto rect = d.viewer().recorder().find(widget);
  return rect && rect->visible;
}

glm::vec2 empty_place(Driver& d) {
  const auto& v = d.workspace().view.viewport;
  return v.origin + glm::vec2(0.5f * v.size.x, v.size.y - 70);
}

workspace::PanelLayout& layout(Driver& d) {
  return d.workspace().preferences.layout;
}

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
  REQUIRE(d.viewer().recorder().find("file_problem"));
  CHECK(d.viewer().recorder().find("file_problem")->y0 >= d.viewer().recorder().find("file_path")->y1);
  CHECK(browser.problem.find("--") == std::string::npos);
  CHECK_FALSE(browser.problem.starts_with(file.string() + ": "));
  CHECK_MESSAGE(d.workspace().messages.all().empty(), browser.problem);
  d.press_key(workspace::Key::escape);
  d.frame(2);
  CHECK_FALSE(browser.open);
}

}  // namespace

TEST_CASE("dragging_the_inner_edge_of_a_column_makes_it_wider_and_the_view_narrower") {
  Driver d;
  d.open_dragon();
  const auto before = d.workspace().view.viewport;
  d.drag({before.origin.x + 3, 60}, {before.origin.x + 83, 60});
  CHECK(d.workspace().view.viewport.origin.x == doctest::Approx(before.origin.x + 80).epsilon(0.02));
  CHECK(d.workspace().view.viewport.size.x < before.size.x - 70);
  const float end = d.workspace().view.viewport.origin.x + d.workspace().view.viewport.size.x;
  d.drag({end - 3, 60}, {end - 43, 60});
  CHECK(layout(d).width[1] == doctest::Approx(360).epsilon(0.02));
  CHECK(d.document().selection().empty());
  // A tab folds and unfolds its column.
  for (const bool shown : {false, true}) {
    d.click("tab/methods");
    d.frame();
    CHECK(is_seen(d, "method_diag") == shown);
    CHECK((d.workspace().view.viewport.size.x > 800) == !shown);
  }
}

TEST_CASE("columns_sections_theme_and_recent_files_are_as_they_were_left") {
  const test::TemporaryFolder folder;
  {
    Driver d(remembering(folder / "state"));
    d.open_dragon();
    d.click("section/Map");
    d.click("tab/methods");
    d.press_key(workspace::key('T'));
    d.frame(2);
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
  CHECK_FALSE(d.viewer().recorder().find("method_diag"));
  d.click("tab/methods");
  d.frame(2);
  CHECK(d.viewer().recorder().find("map"));
}

TEST_CASE("hidden_panels_show_a_hint_to_restore_them") {
  Driver d(test::with_pixels);
  d.open_dragon();
  d.press_key(workspace::Key::f2);
  d.settle();
  const auto with_line = d.picture();
  d.workspace().panels.has_user = false;
  d.settle();
  CHECK(test::difference(with_line, d.picture(), 0) > 0);
  d.workspace().panels.has_user = true;
  d.press_key(workspace::Key::f2);
  d.frame(2);
  CHECK(is_seen(d, "open_model"));
}

TEST_CASE("a_menu_runs_a_command") {
  Driver d;
  d.open_dragon();
  CHECK(d.workspace().view.options.grid);
  d.choose("menu/View", "menu/toggle_grid");
  CHECK_FALSE(d.workspace().view.options.grid);
  d.frame(2);
  CHECK_FALSE(d.viewer().recorder().find("menu/toggle_grid"));  // the menu is closed again
  d.choose("menu/Deform", "menu/method_sd");
  CHECK(d.document().method() == sym3::Method::sd);
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
      const auto rect = d.viewer().recorder().find(std::string("menu/") + name);
      REQUIRE(rect);
      d.click(glm::vec2(0.5f * (rect->x0 + rect->x1), 0.5f * (rect->y0 + rect->y1)));
      d.frame(3);
    }
  };
  menu("Edit", "history");
  const auto& recorder = d.viewer().recorder();
  CHECK(recorder.find("history/60"));
  CHECK(recorder.find("history/10"));
  CHECK_FALSE(recorder.find("history/9"));
  d.click("history/45");
  d.frame(2);
  CHECK(d.document().history().position() == 45);
  CHECK(workspace::find_command("undo")->label_now(d.workspace()) == "Undo Rotate 45");
  workspace::mark_saved(d.workspace());
  menu("File", "recent");
  const auto file = d.workspace().preferences.recent.at(1).file;
  d.click("menu/recent/1");
  d.settle();
  CHECK(d.document().model().path == file);
}

TEST_CASE("a_right_click_opens_a_menu_and_a_right_drag_orbits") {
  Driver d;
  d.open_dragon();
  const auto camera = d.workspace().view.camera.pose();
  const auto v = d.free_vertex();
  d.click(d.vertex(v), 1);
  d.frame(2);
  CHECK(d.document().selection().contains(v));
  CHECK(d.workspace().view.camera.pose() == camera);
  d.click("menu/select_all");
  CHECK(d.document().selection().size() == d.document().pose().positions.size());
  d.frame(2);
  d.drag(empty_place(d), empty_place(d) + glm::vec2(40, 5), 1);
  d.frame(2);
  CHECK_FALSE(d.workspace().view.camera.pose() == camera);
  CHECK_FALSE(d.viewer().recorder().find("menu/select_all"));
  // The menu adds a probe at the place where the menu was opened.
  d.workspace().view.options.cage = false;
  const auto& view = d.workspace().view.viewport;
  d.click(view.origin + glm::vec2(0.5f, 0.62f) * view.size, 1);
  d.frame(2);
  d.click("menu/add_probe");
  d.frame(2);
  CHECK(d.document().probes().all.size() == 1);
}

TEST_CASE("the_palette_runs_commands_by_letters_arrow_keys_and_enter") {
  Driver d;
  d.frame(3);
  d.press_key(workspace::key('K'), true);
  d.frame(2);
  d.type("theme");
  d.frame(2);
  CHECK(is_seen(d, "palette/toggle_theme"));
  const bool dark = d.workspace().view.options.dark;
  d.press_key(workspace::Key::enter);
  CHECK(d.workspace().view.options.dark != dark);
  d.frame(2);
  CHECK_FALSE(d.viewer().recorder().find("palette_text"));
  d.press_key(workspace::Key::f3);
  d.frame(2);
  d.type("save");
  d.frame(2);
  const auto found = workspace::find_commands(d.workspace(), "save");
  REQUIRE(found.size() > 2);
  d.press_key(workspace::Key::down);
  CHECK(d.workspace().panels.palette.highlighted == 1);
  d.press_key(workspace::Key::up);
  d.press_key(workspace::Key::up);
  CHECK(d.workspace().panels.palette.highlighted == found.size() - 1);
  d.press_key(workspace::Key::down);
  CHECK_FALSE(found.front()->enabled(d.workspace()));
  d.press_key(workspace::Key::enter);  // there is nothing to save
  CHECK(d.workspace().panels.palette.open);
  CHECK_FALSE(d.workspace().files.browser.open);
  d.frame(3);
  d.type("z");  // Enter does not end typing
  CHECK(d.workspace().panels.palette.typed.ends_with('z'));
  d.press_key(workspace::Key::escape);
  CHECK_FALSE(d.workspace().panels.palette.open);
}

TEST_CASE("a_message_moves_no_button") {
  Driver d;
  d.open_dragon();
  d.frame(3);
  const auto before = *d.viewer().recorder().find("open_model");
  d.workspace().messages.error("A message that stays");
  d.frame(3);
  const auto after = *d.viewer().recorder().find("open_model");
  CHECK(before.y0 == after.y0);
  CHECK(is_seen(d, "toast/0"));
}

TEST_CASE("an_error_is_shown_until_it_is_dismissed") {
  const test::TemporaryFolder folder;
  Driver d;
  d.open_dragon();
  CHECK_FALSE(d.open({folder / "none.ply"}));
  d.frame(2);
  CHECK(is_seen(d, "toast/0"));
  SUBCASE("it is put away") {
    d.click("toast/0/close");
    d.frame(2);
    CHECK_FALSE(d.viewer().recorder().find("toast/0"));
  }
  SUBCASE("a click shows the list") {
    d.click("toast/0");
    d.frame(2);
    CHECK(is_seen(d, "message/0"));
    d.click("clear_messages");
    CHECK(d.workspace().messages.all().empty());
    d.press_key(workspace::Key::escape);
    d.frame(2);
    CHECK_FALSE(d.workspace().panels.show_messages);
  }
}

TEST_CASE("in_a_save_dialog_typing_replaces_the_name_a_button_its_format_and_unknown_formats_are_refused") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "a_folder");
  Driver d;
  d.open_dragon();
  d.workspace().files.saved.session = folder / "session.viete";  // exports suggest the folder of the session
  for (const char* name : {"first.obj", "second.obj"}) {
    d.press_key(workspace::key('P'), true, true);
    d.frame(3);
    d.type((folder / name).string());
    d.press_key(workspace::Key::enter);
    d.frame(2);
    CHECK(std::filesystem::exists(folder / name));
  }
  d.press_key(workspace::key('E'), true);
  d.frame(3);
  d.type("arm.xyz");
  d.press_key(workspace::Key::enter);
  d.frame(2);
  CHECK(d.workspace().files.browser.open);
  CHECK(d.workspace().files.browser.path == "arm.xyz");
  CHECK(d.viewer().recorder().find("file_problem"));
  d.click("format_ply");
  d.press_key(workspace::Key::enter);
  d.frame(2);
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
  d.frame(3);
  d.type((top / "f_##.obj").string());
  d.press_key(workspace::Key::enter);  // asks before it exports
  CHECK_FALSE(d.workspace().jobs.exporting.running);
  CHECK(d.workspace().files.browser.open);
  CHECK(d.viewer().recorder().find("file_replaces"));
  CHECK(test::file_bytes(top / "f_01.obj") == "somebody else's");
  d.press_key(workspace::Key::enter);
  d.frame(3);
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

TEST_CASE("a_new_model_starts_with_the_first_view_and_without_mirror_and_pivot_of_the_last_one") {
  const test::TemporaryFolder folder;
  Driver d;
  d.open_dragon();
  d.drag(empty_place(d), empty_place(d) + glm::vec2(150, 60), 2);
  document::Handling& hand = d.workspace().view.handling;
  hand.mirror = document::MirrorPlane::x;
  hand.pivot = document::Pivot::point;
  hand.point = mesh::Point{0.25, 1, -3};
  d.workspace().messages.warn("The cage is open", {.scope = workspace::Scope::cage});
  d.frame();
  REQUIRE(d.open({test::dragon_cage}, Driver::What::cage));
  d.frame(2);
  for (const auto& m : d.workspace().messages.all()) CHECK(m.text != "The cage is open");
  CHECK(hand.mirror == document::MirrorPlane::x);
  open_cube(d, folder.path());
  const document::CameraPose home, now = d.workspace().view.camera.pose();
  CHECK(now.yaw == doctest::Approx(home.yaw));
  CHECK(now.pitch == doctest::Approx(home.pitch));
  CHECK(hand.mirror == document::MirrorPlane::none);
  CHECK(hand.pivot == document::Pivot::median);
  CHECK_FALSE(hand.point);
}

TEST_CASE("after_a_resize_frames_go_on_until_the_panels_have_their_sizes") {
  Driver d;
  d.open_dragon();
  for (const glm::ivec2 size : {glm::ivec2(1500, 1000), glm::ivec2(700, 420), glm::ivec2(1280, 700)}) {
    d.viewer().resize(size, 1);
    d.frame();
    for (int i = 0; i < 20 && d.viewer().wants_frame(); ++i) d.frame();
    std::map<std::string, ui::WidgetRect> before = d.viewer().recorder().all();
    d.frame(3);
    for (const auto& [name, rect] : d.viewer().recorder().all()) {
      if (!before.contains(name)) continue;  // skips new widgets
      CHECK_MESSAGE(std::abs(before[name].x1 - rect.x1) + std::abs(before[name].y0 - rect.y0) < 0.01f, name);
    }
    if (!d.workspace().files.browser.open)
      d.press_key('O', true);  // the file browser stays open in later rounds
    d.frame(3);
    for (const char* name : {"file_path", "file_choose"}) {
      const auto rect = d.viewer().recorder().find(name);
      REQUIRE(rect);
      CHECK(rect->x1 <= static_cast<float>(size.x));
      CHECK(rect->y1 <= static_cast<float>(size.y));
    }
  }
}
