// No widget of a panel may be outside the window or cover another widget, at the scales 1 and 2. Also:
// resized windows and hidden panels.
#include "document/pose_edit.h"
#include "document/time_edit.h"
#include "program/open_cage.h"
#include "support/folder.h"
#include "support/pictures.h"
#include "ui/system_fonts.h"
#include "workspace/open_save.h"

using namespace viete;
using test::Dragon, test::Driver;
namespace fs = std::filesystem;

namespace {

using Widgets = std::map<std::string, ui::WidgetRect>;

constexpr float column = 320, rounding = 0.5f;

bool overlap(const ui::WidgetRect& a, const ui::WidgetRect& b) {
  return a.x0 + rounding < b.x1 && b.x0 + rounding < a.x1 && a.y0 + rounding < b.y1 && b.y0 + rounding < a.y1;
}

bool in_column(const ui::WidgetRect& rect, glm::vec2 window) {
  return rect.x1 <= column || rect.x0 >= window.x - column;
}

bool on_notice_bar(const std::string& name) {
  return name.ends_with("_leftover") || name.ends_with("_leftovers") || name.starts_with("recovery/");
}

void check_places(const Widgets& widgets, glm::vec2 window) {
  CHECK(widgets.size() > 20);
  for (auto a = widgets.begin(); a != widgets.end(); ++a) {
    const auto& [name, rect] = *a;
    CAPTURE(name);
    if (!rect.visible) continue;
    CHECK(rect.x1 > rect.x0);
    CHECK(rect.y1 > rect.y0);
    CHECK(rect.x0 >= 0);
    CHECK(rect.x1 <= window.x);
    if (name.starts_with("menu/") || on_notice_bar(name)) continue;  // these may cover other widgets
    if (rect.x0 < column) CHECK(rect.x1 <= column);
    if (rect.x1 > window.x - column) CHECK(rect.x0 >= window.x - column);
    for (auto b = std::next(a); b != widgets.end(); ++b) {
      const bool both_in_column =
          b->second.visible && in_column(rect, window) && in_column(b->second, window);
      const bool both_asked = name.starts_with("question_") && b->first.starts_with("question_");
      const bool both_told = on_notice_bar(name) && on_notice_bar(b->first);
      const bool both_timed = name.starts_with("time/") && b->first.starts_with("time/");
      CHECK_MESSAGE(!((both_in_column || both_asked || both_told || both_timed) && overlap(rect, b->second)),
                    "covers ", b->first);
    }
  }
}

void check(Driver& d, const char* what) {
  CAPTURE(what);
  d.move({1270, 1100});
  d.frame(2);
  check_places(d.recorder().all(), {1280, 1500});
}

void check_questions(Driver& d) {
  auto& w = d.workspace();
  const auto name = workspace::name_of_work(w);
  for (const workspace::Question& question :
       {workspace::ask_before_closing(
            name,
            "/home/somebody/.local/state/viete/recovery: unsaved edits cannot be saved "
            "here for recovery: Not a directory; save often"),
        workspace::ask_before_opening(name, "There is no home folder for backups."),
        workspace::ask_before_replacing("/home/somebody/a_walk_with_a_long_name.viete")}) {
    w.files.question = question;
    check(d, question.title.c_str());
    REQUIRE(d.recorder().find("question_cancel"));
  }
  w.files.question.reset();
}

void check_notices(Driver& d) {
  auto& w = d.workspace();
  w.recovery.files = {{"/a.viete", "walk.viete", 0, "/home/somebody/animations/of/a/dragon"},
                      {"/b.viete", "b", 0}};
  w.recovery.offered = true;
  check(d, "recovery files");
  w.recovery.files.pop_back();
  check(d, "one recovery file");
  w.recovery.files.clear();
}

void check_time(Driver& d) {
  auto& w = d.workspace();
  for (int i = 0; i < 2; ++i) d.click("keep_pose");
  w.document.put_frame(1);
  document::set_key(w.document, 1);
  document::set_key(w.document, 30);
  document::set_camera_key(w.document, 10, w.view.camera.pose());
  w.preferences.layout.timeline = true;
  d.frame(3);
  check(d, "timeline");
  document::rename_pose(w.document, 0, "a smile with a name that is too long for its row");
  for (const auto& [pose, frame, weight] : {std::tuple(0, 1, 0.0), {0, 12, 1.0}, {0, 40, 0.25}, {1, 20, 0.5}})
    document::set_weight_key(w.document, static_cast<std::size_t>(pose), frame, weight);
  d.frame(3);
  check(d, "timeline with weights");
  w.preferences.layout.timeline = false;
}

void visit_panels(Driver& d) {
  const test::TemporaryFolder scratch;
  const fs::path cage = test::open_cage(scratch.path());
  check(d, "empty");
  REQUIRE(d.open({test::dragon, cage}));
  d.settle();
  d.workspace().view.options.model = false;  // not needed for the layout
  d.press_key(workspace::key('A'));
  d.workspace().preferences.layout.sections["Checks"] = true;
  d.frame(2);
  REQUIRE(d.recorder().find("finding/0"));
  pose::Pose pose = d.document().pose();
  for (std::size_t i = 0; i < pose.positions.size(); i += 3) pose.positions[i][1] *= 1.2;
  document::set_pose(d.document(), pose);
  check(d, "all sections");
  d.run("map_exp_error");
  d.press_key(workspace::key('E'));
  check(d, "error map");
  CHECK_FALSE(d.open({scratch / "none.ply", cage}));
  check(d, "failed load");
  for (const char key : {'O', 'E'}) {
    d.press_key(workspace::key(key), true);
    check(d, "file dialog");
    d.press_key(workspace::Key::escape);
  }
  check_time(d);
  check_questions(d);
  check_notices(d);
  d.press_key(workspace::Key::f1);
  check(d, "keys and mouse");
}

}  // namespace

TEST_CASE("no_panel_leaves_the_window_or_covers_another_at_any_scale") {
  for (const float scale : {1.0f, 2.0f}) {
    auto options = Driver::default_options({1280, 1500});
    options.scale = scale;
    options.probe = false;
    Driver d(options);
    visit_panels(d);
  }
}

TEST_CASE("names_in_other_scripts_are_drawn_if_a_font_of_the_system_has_them") {
  struct Names {
    const char *one, *other;
    std::set<char32_t> characters;
  };
  const Names all[] = {{"\u0416", "\u0424", {0x416, 0x424}},     // Cyrillic
                       {"\u0639", "\u0641", {0x639, 0x641}},     // Arabic
                       {"\u4e2d", "\u56fd", {0x4e2d, 0x56fd}},   // Chinese, Japanese
                       {"\ud55c", "\uae00", {0xd55c, 0xae00}}};  // Korean
  Dragon d("", test::with_pixels);
  d.run("keep_pose");
  const auto shown = [&](const char* name) {
    document::rename_pose(d.document(), 0, name);
    d.settle();
    d.frame(3);
    return d.picture();
  };
  for (const Names& names : all) {
    const auto fonts = ui::fonts_with(names.characters);
    if (fonts.empty() || fonts[0].characters != names.characters) continue;
    CAPTURE(names.one);
    CHECK(test::difference(shown(names.one), shown(names.other), 12) > 0);  // "?" would be the same
  }
}

TEST_CASE("after_a_resize_frames_go_on_until_the_panels_have_their_sizes") {
  Dragon d;
  for (const glm::ivec2 size : {glm::ivec2(1500, 1000), glm::ivec2(700, 420), glm::ivec2(1280, 700)}) {
    d.viewer().resize(size, 1);
    d.frame();
    for (int i = 0; i < 20 && d.viewer().wants_frame(); ++i) d.frame();
    Widgets before = d.recorder().all();
    d.frame(3);
    for (const auto& [name, rect] : d.recorder().all()) {
      if (!before.contains(name)) continue;  // skips new widgets
      CHECK_MESSAGE(std::abs(before[name].x1 - rect.x1) + std::abs(before[name].y0 - rect.y0) < 0.01f, name);
    }
    if (!d.workspace().files.browser.open)
      d.press_key('O', true);  // the file browser stays open in later rounds
    d.frame(3);
    for (const char* name : {"file_path", "file_choose"}) {
      const auto rect = d.recorder().find(name);
      REQUIRE(rect);
      CHECK(rect->x1 <= static_cast<float>(size.x));
      CHECK(rect->y1 <= static_cast<float>(size.y));
    }
  }
}

TEST_CASE("hidden_panels_show_a_hint_to_restore_them") {
  Dragon d("", test::with_pixels);
  d.press_key(workspace::Key::f2);
  d.settle();
  const auto with_line = d.picture();
  d.workspace().panels.has_user = false;
  d.settle();
  CHECK(test::difference(with_line, d.picture(), 0) > 0);
  d.workspace().panels.has_user = true;
  d.press_key(workspace::Key::f2);
  CHECK(d.is_seen("open_model"));
}
