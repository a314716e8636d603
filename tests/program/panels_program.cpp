// Every panel, in both themes and at both scales: nothing leaves the window, nothing covers anything else.
//
// VIETE_PICTURES=FOLDER also writes a picture of each.
#include <cstdlib>

#include "program/open_cage.h"
#include "render/image.h"
#include "scene/document/pose_edit.h"
#include "scene/document/time_edit.h"
#include "scene/files/open.h"
#include "scene/workspace/choice_commands.h"
#include "scene/workspace/saving.h"
#include "support/folder.h"

using namespace viete;
using test::Driver;
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
  return name.ends_with("_leftover") || name.ends_with("_leftovers");
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
    if (name.starts_with("menu/") || on_notice_bar(name)) continue;  // in front of everything
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

void show(Driver& d, const std::string& name) {
  d.move({1270, 1100});
  const char* folder = std::getenv("VIETE_PICTURES");
  if (folder) d.settle();
  CAPTURE(name);
  check_places(d.viewer().recorder().all(), {1280, 1500});
  if (folder) render::write_png(fs::path(folder) / (name + ".png"), d.picture());
}

void visit_questions(Driver& d, const std::string& look) {
  auto& w = d.workspace();
  w.question = scene::ask_before_closing(scene::name_of_work(w),
                                         "/home/somebody/.local/state/viete/recovery: unsaved edits cannot "
                                         "be saved here for recovery: Not a directory; save often");
  d.frame(2);
  show(d, look + "_question_close");
  REQUIRE(d.viewer().recorder().find("question_go_on"));
  w.question = scene::ask_before_opening(scene::name_of_work(w), "There is no home folder to save them in.");
  w.question->chosen = 2;
  d.frame(2);
  show(d, look + "_question_open");
  w.question = scene::ask_before_replacing("/home/somebody/a_walk_with_a_long_name.viete");
  d.frame(2);
  show(d, look + "_question_replace");
  w.question.reset();
  d.frame(2);
}

void visit_notices(Driver& d, const std::string& look) {
  auto& w = d.workspace();
  w.recovery_files = {
      {"/a.viete", "walk.viete", 0, "/home/somebody/animations/of/a/dragon", "move 3 vertices"},
      {"/b.viete", "b", 0}};
  w.offers_recovery = true;
  d.frame(3);
  show(d, look + "_leftovers");
  w.recovery_files.pop_back();
  d.frame(3);
  show(d, look + "_leftover");
  w.recovery_files.clear();
  d.frame(3);
}

void visit_time(Driver& d, const std::string& look) {
  auto& w = d.workspace();
  for (int i = 0; i < 2; ++i) d.click("keep_pose");
  w.document.frame = 1;
  scene::set_key(w.document, 1);
  scene::set_key(w.document, 30);
  scene::set_camera_key(w.document, 10, w.camera.pose());
  w.preferences.layout.timeline = true;
  d.frame(3);
  show(d, look + "_time");
  w.preferences.layout.timeline = false;
}

void visit_panels(Driver& d, const std::string& look) {
  const test::TemporaryFolder scratch;
  const fs::path cage = test::open_cage(scratch.path());
  show(d, look + "_empty");
  REQUIRE(d.open({test::dragon, cage}));
  d.settle();
  d.workspace().view.model = std::getenv("VIETE_PICTURES") != nullptr;  // layout needs no drawn model
  d.press_key(scene::key('A'));
  d.click("section/Checks");
  if (!d.viewer().recorder().find("finding/0"))
    d.click("section/Checks");  // it was open, as there is a finding
  REQUIRE(d.viewer().recorder().find("finding/0"));
  deform::Pose pose = d.document().pose;
  for (std::size_t i = 0; i < pose.positions.size(); i += 3) pose.positions[i][1] *= 1.2;
  scene::set_pose(d.document(), pose);
  show(d, look + "_all_sections");

  d.run("toggle_error_map");
  d.press_key(scene::key('E'));
  show(d, look + "_error_map_rotate");
  CHECK_FALSE(d.open({scratch / "none.ply", cage}));
  show(d, look + "_failed_load");

  d.press_key(scene::key('O'), true);
  show(d, look + "_open");
  d.press_key(scene::Key::escape);
  d.press_key(scene::key('E'), true);
  show(d, look + "_export");
  d.press_key(scene::Key::escape);
  visit_time(d, look);
  visit_questions(d, look);
  visit_notices(d, look);
  d.press_key(scene::Key::f1);
  show(d, look + "_help");
}

}  // namespace

TEST_CASE("no_panel_leaves_the_window_or_covers_another_at_any_scale") {
  for (const float scale : {1.0f, 2.0f}) {
    for (const bool dark : {true, false}) {
      if (!dark && std::getenv("VIETE_PICTURES") == nullptr)
        continue;  // the layout is the same in both themes
      auto options = Driver::default_options();
      options.size = {1280, 1500};
      options.scale = scale;
      options.probe = std::getenv("VIETE_PICTURES") != nullptr;  // pictures show everything
      options.builtin_font = !options.probe;
      Driver d(options);
      d.workspace().view.dark = dark;
      visit_panels(d, std::string(dark ? "dark" : "light") + (scale == 1 ? "_1x" : "_2x"));
    }
  }
}

TEST_CASE("questions_and_notices_fit_into_the_smallest_window_and_cover_neither_view_nor_columns") {
  for (const glm::ivec2 size : {glm::ivec2(512, 320), glm::ivec2(640, 400), glm::ivec2(1024, 640)}) {
    auto options = Driver::default_options();
    options.size = size;
    options.scale = 2;
    Driver d(options);
    d.open_dragon();
    const std::string name = "a_model_whose_name_somebody_took_some_time_to_think_about_and_then_more.ply";
    auto& w = d.workspace();
    w.recovery_files = {{"/a.viete", name, 0}, {"/b.viete", "b", 0}};
    w.offers_recovery = true;
    w.question = scene::ask_before_closing(
        scene::name_of_work(w), "/" + std::string(300, 'x') + ": unsaved edits cannot be saved here");
    d.frame(5);
    CAPTURE(size.x);
    std::size_t seen = 0;
    for (const auto& [widget, rect] : d.viewer().recorder().all()) {
      if (!widget.starts_with("question_") && !on_notice_bar(widget)) continue;
      CAPTURE(widget);
      ++seen;
      CHECK(rect.visible);
      CHECK(rect.x0 >= 0);
      CHECK(rect.x1 <= static_cast<float>(size.x));
      CHECK(rect.y0 >= 0);
      CHECK(rect.y1 <= (on_notice_bar(widget) ? w.viewport.origin.y : static_cast<float>(size.y)));
    }
    CHECK(seen == 6);
    w.question.reset();
    d.frame(3);
    if (const char* folder = std::getenv("VIETE_PICTURES")) {
      d.settle();
      render::write_png(fs::path(folder) / ("notice_" + std::to_string(size.x) + ".png"), d.picture());
    }
    d.click("put_off_leftovers");
    d.frame(3);
    CHECK(w.viewport.origin.y == scene::PanelLayout::menu_height);
  }
}

namespace {

bool within(const ui::WidgetRect& rect, glm::vec2 window) {
  return rect.x0 >= 0 && rect.y0 >= 0 && rect.x1 <= window.x && rect.y1 <= window.y;
}

// With its list open, over each entry.
template <class Entry>
void visit_chooser(Driver& d, const char* chooser, std::span<const Entry> table, const std::string& look) {
  const glm::vec2 window = d.workspace().viewport.window;
  d.move(d.place_of(chooser));
  d.frame(2);
  REQUIRE(d.viewer().recorder().find("choice_picture"));
  d.click(chooser);
  d.frame(2);
  for (const Entry& e : table) {
    const std::string name = scene::choice_command_name(e.value);
    CAPTURE(name);
    d.move(d.place_of(name));
    d.frame(3);
    const auto picture = d.viewer().recorder().find("choice_picture");
    REQUIRE(picture);
    CHECK(within(*picture, window));
    CHECK_FALSE(overlap(*picture, *d.viewer().recorder().find(name)));
    if (const char* folder = std::getenv("VIETE_PICTURES"))
      render::write_png(fs::path(folder) / (look + "_" + name + ".png"), d.picture());
  }
  d.click(glm::vec2(window.x - 20, 20));  // closes it
  d.frame(2);
}

}  // namespace

TEST_CASE("each_entry_of_a_chooser_shows_its_picture_beside_the_list") {
  for (const float scale : {1.0f, 2.0f}) {
    for (const bool dark : {true, false}) {
      if (!dark && std::getenv("VIETE_PICTURES") == nullptr) continue;
      auto options = Driver::default_options();
      options.size = {640, 1000};
      options.scale = scale;
      options.builtin_font = std::getenv("VIETE_PICTURES") == nullptr;
      Driver d(options);
      d.workspace().view.dark = dark;
      d.open_dragon();
      const std::string look = std::string(dark ? "dark" : "light") + (scale == 1 ? "_1x" : "_2x");
      visit_chooser(d, "way", scene::all_ways(), look);
      visit_chooser(d, "weights", scene::all_weights(), look);
      visit_chooser(d, "blend", scene::all_blends(), look);
    }
  }
}
