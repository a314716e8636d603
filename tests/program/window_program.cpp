// Compares a window on a virtual display with the offscreen program, with mouse and keyboard.
#include <sstream>

#include "formats/write.h"
#include "program/desktop.h"
#include "program/driver.h"
#include "support/ball.h"
#include "support/pictures.h"
#include "workspace/open_save.h"

using namespace viete;
using test::Child;
using test::Desktop;
using test::Driver;
using test::f12_keycode;
using test::wait_until;
namespace fs = std::filesystem;

namespace {

constexpr const char* f11_keycode = "95";  // see test::f12_keycode

// Makes the side columns and the bars black, because fonts differ between systems.
void cut_panels(render::Image& image) {
  constexpr int left = 384, right = 320, top = 40, bottom = 26;
  for (int y = 0; y < image.height; ++y) {
    const bool bar = y >= image.height - bottom || y < top;
    const auto row = image.rgba.begin() + 4 * std::ptrdiff_t(y) * image.width;
    std::fill_n(row, 4 * (bar ? image.width : left), std::uint8_t{0});
    std::fill_n(row + 4 * (image.width - right), 4 * right, std::uint8_t{0});
  }
}

// The offscreen program, which opens and draws the dragon as the window does.
struct Offscreen : Driver {
  Offscreen() : Driver(options(), test::with_pixels) {
    workspace().document.put_deformer(pose::default_deformer());
    open_dragon("", test::bundled_dragon);
    frame();
    workspace::frame_all(workspace(), false);
    settle();
  }
  static app::ViewerOptions options() {
    auto options = default_options({1440, 900});
    options.samples = 4;
    return options;
  }
};

std::string at(glm::vec2 place) {
  const glm::ivec2 p(glm::round(place));
  return std::to_string(p.x) + ' ' + std::to_string(p.y);
}

// A session that is open in a window: a ball, with a larger ball as its cage.
struct RealSession {
  Desktop desktop;
  fs::path session = desktop.folder / "work.viete";
  std::optional<Child> viewer;

  RealSession() {
    formats::write(desktop.folder / "ball.obj", test::ball(1, 3));
    formats::write(desktop.folder / "cage.obj", test::ball(1.3, 1));
    Driver offscreen;
    REQUIRE(offscreen.open({desktop.folder / "ball.obj", desktop.folder / "cage.obj"}));
    REQUIRE(workspace::save_session(offscreen.workspace(), session));
    viewer.emplace(desktop.viete("work.viete"), desktop.folder / "viete.log");
    desktop.xdotool("search --sync --onlyvisible --name work");
    desktop.rest();
    saved();
  }

  void act(const std::string& words) { desktop.xdotool(words); }
  /// Presses Ctrl+S until the session is saved, then reads it. The window handles all earlier events first.
  files::Session saved() {
    const auto before = fs::last_write_time(session);
    const auto written = [&] { return fs::last_write_time(session) != before; };
    for (int i = 0; i < 15 && !written(); ++i) {
      act("key ctrl+s");
      wait_until(written, 20);
    }
    REQUIRE(written());
    return files::read_session(session);
  }
  void quit() {
    act("key ctrl+q");
    REQUIRE(wait_until([&] { return viewer->finished(); }));
    CHECK(viewer->exit_code() == 0);
  }
};

}  // namespace

TEST_CASE("a_real_mouse_and_keys_in_a_real_window_give_the_picture_of_the_offscreen_program" *
          doctest::test_suite(test::if_present)) {
  if (test::no_desktop()) return;
  Offscreen d;
  const glm::ivec2 from(glm::round(d.vertex(d.free_vertex()))), to = from + glm::ivec2(72, -56);
  d.drag(from, to);
  d.move({1000, 20});
  d.press_key('A');
  d.press_key('E');
  const glm::ivec2 ring(
      glm::round(workspace::gizmo_of(d.workspace())->center + glm::vec2(interact::gizmo_view_ring, 0)));
  d.press_and_move(ring, ring + glm::ivec2(0, -24));
  d.type("30");
  d.press_key(workspace::Key::enter);
  d.button(0, false);
  d.move({1430, 20});
  d.frame(3);
  auto offscreen = d.picture();

  Desktop desktop;
  Child viewer(desktop.viete(""), desktop.folder / "viete.log");
  desktop.xdotool("search --sync --onlyvisible --name dragon");
  desktop.rest();
  desktop.drag(from, to);
  desktop.xdotool("mousemove 1000 20");
  desktop.xdotool("key a");
  desktop.xdotool("key e");
  desktop.xdotool("mousemove " + at(ring));
  desktop.xdotool("mousedown 1");
  for (int i = 1; i <= 8; ++i) desktop.xdotool("mousemove " + at(ring + glm::ivec2(0, -24) * i / 8));
  desktop.xdotool("type --delay 120 30");
  desktop.xdotool("key Return");
  desktop.xdotool("mouseup 1");
  desktop.xdotool("mousemove 1430 20");
  desktop.rest();
  desktop.xdotool(std::string("key ") + f12_keycode);
  REQUIRE(wait_until([&] { return desktop.screenshot().has_value(); }));
  auto real = test::read_png(*desktop.screenshot());
  desktop.xdotool("key ctrl+q");
  REQUIRE(wait_until([&] { return viewer.finished(); }));
  CHECK(viewer.exit_code() == 0);

  REQUIRE(real.width == offscreen.width);
  REQUIRE(real.height == offscreen.height);
  cut_panels(real);
  cut_panels(offscreen);
  const double differing = test::difference(real, offscreen, 2);
  if (differing > 0.001) {
    render::write_png(test::build_dir() / "window-real.png", real);
    render::write_png(test::build_dir() / "window-offscreen.png", offscreen);
  }
  CHECK(differing <= 0.001);
}

TEST_CASE("a_window_closes_at_once_when_edits_are_kept_and_asks_when_they_are_not" *
          doctest::test_suite(test::if_present)) {
  if (test::no_desktop()) return;
  Offscreen d;
  const glm::ivec2 from(glm::round(d.vertex(d.free_vertex()))), to = from + glm::ivec2(72, -56);

  for (const bool can_keep : {true, false}) {
    CAPTURE(can_keep);
    Desktop desktop;
    const fs::path state = desktop.folder / "state" / "viete", log = desktop.folder / "viete.log";
    fs::create_directories(state);
    if (!can_keep) test::put_file(state / "recovery", "a file, not a folder");
    Child viewer(desktop.viete(""), log);
    desktop.xdotool("search --sync --onlyvisible --name dragon");
    desktop.rest();
    desktop.drag(from, to);
    desktop.rest();
    const std::string at_work = desktop.screen();
    viewer.terminate();
    if (can_keep) {
      REQUIRE(wait_until([&] { return viewer.finished(); }));
      CHECK(viewer.exit_code() == 0);
      CHECK(test::file_bytes(log).find("unsaved edits were backed up") != std::string::npos);
      continue;
    }
    desktop.rest(at_work);
    CHECK_FALSE(viewer.finished());
    desktop.xdotool_seen("key Escape");  // closes the question
    const std::string again_at_work = desktop.screen();
    viewer.terminate();
    desktop.rest(again_at_work);
    CHECK_FALSE(viewer.finished());
    desktop.xdotool_seen("key Escape");
    desktop.xdotool_seen("key ctrl+q");
    CHECK_FALSE(viewer.finished());
    desktop.xdotool("key Left");
    desktop.xdotool("key Return");  // closes without saving
    REQUIRE(wait_until([&] { return viewer.finished(); }));
    CHECK(viewer.exit_code() == 0);
    CHECK(test::file_bytes(log).find("kept") == std::string::npos);
  }
}

TEST_CASE("f11_fills_the_screen_and_gives_the_window_its_size_back" * doctest::test_suite(test::if_present)) {
  if (test::no_desktop()) return;
  RealSession hand;
  const auto size = [&] {
    const fs::path out = hand.desktop.folder / "size";
    const std::string command = "DISPLAY=" + hand.desktop.display +
                                " xdotool search --onlyvisible --name work getwindowgeometry --shell >'" +
                                out.string() + "' 2>/dev/null";
    glm::ivec2 found(0);
    if (std::system(command.c_str()) != 0) return found;
    std::istringstream lines(test::file_bytes(out));
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("WIDTH=")) found.x = std::stoi(line.substr(6));
      if (line.starts_with("HEIGHT=")) found.y = std::stoi(line.substr(7));
    }
    return found;
  };
  const glm::ivec2 small(1000, 700), screen(1440, 900);
  hand.act("search --onlyvisible --name work windowsize 1000 700");
  REQUIRE(wait_until([&] { return size() == small; }));
  hand.act("mousemove 500 300");
  hand.saved();
  hand.act(std::string("key ") + f11_keycode);
  CHECK(wait_until([&] { return size() == screen; }));
  hand.saved();
  hand.act(std::string("key ") + f11_keycode);
  CHECK(wait_until([&] { return size() == small; }));
  hand.quit();
  const auto preferences =
      workspace::read_preferences(hand.desktop.folder / "state" / "viete" / "remembered.json");
  CHECK(preferences.window == small);
}
