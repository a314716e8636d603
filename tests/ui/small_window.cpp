// All controls must be usable in a window of any size and scale.
#include "support/commands.h"
#include "ui/panel_driver.h"
#include "workspace/open_save.h"

using namespace viete;
using test::PanelDriver;

namespace {

struct WindowSize {
  glm::ivec2 device;
  float scale;
};

// The smallest window, and common screen sizes.
const WindowSize sizes[] = {
    {{640, 400}, 1}, {{1280, 800}, 2}, {{1366, 768}, 1}, {{1920, 1080}, 1.25f}, {{2880, 1620}, 1.5f}};

const char* const tools[] = {"tool_select", "tool_move",    "tool_rotate",  "tool_scale", "tool_paint",
                             "select_box",  "select_lasso", "select_brush", "edit_cage",  "add_probe"};
const char* const commands_of_time[] = {"first_frame",    "previous_key",    "play",
                                        "next_key",       "last_frame",      "set_key",
                                        "set_camera_key", "toggle_auto_key", "save_animation"};
const char* const fields_of_time[] = {"time/frame",  "time/first",     "time/last",   "time/rate",
                                      "time/repeat", "time/log_space", "time/linear", "time/easing"};

bool is_on_notice_bar(const std::string& name) {
  return name.ends_with("_leftover") || name.ends_with("_leftovers") || name.starts_with("recovery/");
}

bool is_inside(PanelDriver& d, const std::string& widget) {
  const auto rect = d.recorder().find(widget);
  const glm::vec2 end = d.workspace().view.camera.viewport.window;
  return rect && rect->visible && rect->x0 >= 0 && rect->y0 >= 0 && rect->x1 <= end.x && rect->y1 <= end.y;
}

// True if the widget is visible, or is in the menu of the button `more`. Closes the menu at the end.
bool is_in_reach(PanelDriver& d, const std::string& there, const std::string& in_menu,
                 const std::string& more) {
  if (is_inside(d, there)) return true;
  if (!is_inside(d, more)) return false;
  d.click(more);
  const bool found = is_inside(d, in_menu);
  d.press_key(workspace::Key::escape);
  return found;
}

}  // namespace

TEST_CASE("all_of_strip_and_timeline_is_in_the_window_or_in_the_menu_at_its_end") {
  int in_menus = 0;
  for (const auto& [device, scale] : sizes) {
    CAPTURE(device.x);
    CAPTURE(device.y);
    PanelDriver d(test::ball_workspace(2), glm::vec2(device) / scale, scale);
    d.workspace().preferences.layout.timeline = true;
    test::run_command(d.workspace(), "set_key");
    d.frame(4);
    for (const std::string tool : tools) {
      CHECK_MESSAGE(is_in_reach(d, "strip/" + tool, "menu/" + tool, "strip/more"), tool);
      in_menus += !is_inside(d, "strip/" + tool);
    }
    for (const std::string command : commands_of_time) {
      CHECK_MESSAGE(is_in_reach(d, "time/" + command, "menu/" + command, "time/more"), command);
      in_menus += !is_inside(d, "time/" + command);
    }
    for (const std::string field : fields_of_time) {
      const bool range = field != "time/frame";
      CHECK_MESSAGE(is_in_reach(d, field, field, range ? "time/more_of_range" : "time/more"), field);
      in_menus += !is_inside(d, field);
    }
    for (const char* menu : {"File", "Time", "Help"})
      CHECK_MESSAGE(is_inside(d, std::string("menu/") + menu), menu);
  }
  CHECK(in_menus > 20);
}

TEST_CASE("overflow_menus_of_strip_and_timeline_work") {
  PanelDriver d(test::ball_workspace(2), {1024, 640});
  d.workspace().preferences.layout.timeline = true;
  d.frame(3);
  const auto pick = [&](const char* menu, const char* entry) {
    d.click(menu);
    d.click(entry);
  };
  pick("strip/more", "menu/add_probe");
  CHECK(d.document().probes().all.size() == 1);
  pick("time/more", "menu/toggle_auto_key");
  CHECK(d.workspace().playback.auto_key);
  pick("time/more_of_range", "time/linear");
  CHECK(d.document().timeline().linear);
}

TEST_CASE("dialogs_are_inside_a_small_window") {
  PanelDriver d(test::ball_workspace(2), {800, 500});
  d.workspace().preferences.layout.timeline = true;
  const std::pair<const char*, std::string> dialogs[] = {
      {"command_palette", "palette_text"}, {"help", "keys_text"}, {"show_messages", "clear_messages"}};
  for (const auto& [command, widget] : dialogs) {
    d.run(command);
    CHECK_MESSAGE(is_inside(d, widget), command);
    d.press_key(workspace::Key::escape);
  }
}

TEST_CASE("questions_and_notices_fit_into_the_smallest_window_and_cover_neither_view_nor_columns") {
  for (const glm::ivec2 size : {glm::ivec2(512, 320), glm::ivec2(640, 400), glm::ivec2(1024, 640)}) {
    PanelDriver d(test::ball_workspace(2), size, 2);
    const std::string name = "a_model_whose_name_somebody_took_some_time_to_think_about_and_then_more.ply";
    auto& w = d.workspace();
    w.recovery.files = {{"/a.viete", name, 0}, {"/b.viete", "b", 0}};
    w.recovery.offered = true;
    w.files.question = workspace::ask_before_closing(
        workspace::name_of_work(w), "/" + std::string(300, 'x') + ": unsaved edits cannot be saved here");
    d.frame(5);
    CAPTURE(size.x);
    std::size_t seen = 0;
    for (const auto& [widget, rect] : d.recorder().all()) {
      if (!widget.starts_with("question_") && !is_on_notice_bar(widget)) continue;
      CAPTURE(widget);
      ++seen;
      CHECK(rect.visible);
      CHECK(rect.x0 >= 0);
      CHECK(rect.x1 <= static_cast<float>(size.x));
      CHECK(rect.y0 >= 0);
      CHECK(rect.y1 <=
            (is_on_notice_bar(widget) ? w.view.camera.viewport.origin.y : static_cast<float>(size.y)));
    }
    CHECK(seen == 8);
    w.files.question.reset();
    d.frame(3);
    d.click("put_off_leftovers");
    CHECK(w.view.camera.viewport.origin.y == workspace::PanelLayout::menu_height);
  }
}
