// Real mouse and keyboard events in the real window: mirror, soft selection, pivot, box selection over a
// dense cage, palette, dialog and full screen. Results are read from the saved session.
#include <cmath>
#include <sstream>

#include "mesh/formats/write.h"
#include "program/desktop.h"
#include "program/driver.h"
#include "scene/ball.h"
#include "scene/files/session.h"
#include "scene/workspace/saving.h"
#include "support/folder.h"

using namespace viete;
using test::Child;
using test::Desktop;
using test::Driver;
using test::wait_until;
namespace fs = std::filesystem;

namespace {

constexpr const char* f11_keycode = "95";  // as test::f12_keycode

std::string at(glm::vec2 place) {
  const glm::ivec2 p(glm::round(place));
  return std::to_string(p.x) + ' ' + std::to_string(p.y);
}

std::string drag_words(glm::vec2 from, glm::vec2 to, const std::string& meanwhile = "") {
  std::string words = "mousemove " + at(from) + " sleep 0.1 mousedown 1 sleep 0.05 ";
  for (int i = 1; i <= 4; ++i)
    words += "mousemove " + at(from + (to - from) * (0.25f * float(i))) + " sleep 0.05 ";
  return words + meanwhile + " mouseup 1 sleep 0.1";
}

// A ball in a ball-shaped cage, as a session open offscreen, to locate widgets, and in a real window.
struct RealSession {
  Desktop desktop;
  fs::path session = desktop.folder / "work.viete";
  Driver offscreen{options()};
  std::optional<Child> viewer;

  explicit RealSession(int levels) {
    mesh::write(desktop.folder / "ball.obj", test::ball(1, 3));
    mesh::write(desktop.folder / "cage.obj", test::ball(1.3, levels));
    REQUIRE(offscreen.open({desktop.folder / "ball.obj", desktop.folder / "cage.obj"}));
    offscreen.settle();
    REQUIRE(scene::save_session(offscreen.workspace(), session));
    viewer.emplace(desktop.viete("work.viete"), desktop.folder / "viete.log");
    desktop.xdotool("search --sync --onlyvisible --name work");
    desktop.rest();
    saved();
  }
  static app::ViewerOptions options() {
    auto options = Driver::default_options();
    options.size = {1440, 900};
    return options;
  }

  void act(const std::string& words) { desktop.xdotool(words); }
  /// The program's current state after all events, which are handled in order. Retries until the window has
  /// the keyboard focus.
  scene::Session saved() {
    const auto before = fs::last_write_time(session);
    const auto written = [&] { return fs::last_write_time(session) != before; };
    for (int i = 0; i < 15 && !written(); ++i) {
      act("key ctrl+s");
      wait_until(written, 20);
    }
    REQUIRE(written());
    return scene::read_session(session);
  }
  void quit() {
    act("key ctrl+q");
    REQUIRE(wait_until([&] { return viewer->finished(); }));
    CHECK(viewer->exit_code() == 0);
  }
  const std::vector<mesh::Point>& rest() { return offscreen.document().cage->surface.positions; }
  std::size_t moved(const scene::Session& now) {
    std::size_t count = 0;
    for (std::size_t v = 0; v < rest().size(); ++v) count += now.pose->positions[v] != rest()[v];
    return count;
  }
};

}  // namespace

TEST_CASE("a_real_mouse_draws_a_box_over_a_dense_cage_and_real_keys_find_commands_and_files" *
          doctest::test_suite(test::if_present)) {
  if (test::no_desktop()) return;
  RealSession hand(3);
  const auto& v = hand.offscreen.workspace().viewport;
  const glm::vec2 middle = glm::round(v.origin + 0.5f * v.size), from = middle - glm::vec2(150, 110),
                  to = middle + glm::vec2(140, 120);
  hand.offscreen.press_key('B');
  hand.offscreen.drag(from, to);
  const auto expected = hand.offscreen.document().selection.indices();
  REQUIRE(expected.size() > 40);
  hand.act("mousemove " + at(from) + " key b");
  hand.saved();
  hand.act(drag_words(from, to));
  const auto boxed = hand.saved();
  CHECK(boxed.selection == expected);
  CHECK(hand.moved(boxed) == 0);

  // A slowly drawn window needs some frames to get the keyboard focus.
  hand.desktop.xdotool_seen("key ctrl+k");
  hand.desktop.xdotool_seen("type --delay 60 wire");
  hand.desktop.xdotool_seen("key Return");
  CHECK(hand.saved().view.wireframe);

  hand.desktop.xdotool_seen("key ctrl+shift+s");
  hand.desktop.xdotool_seen("key ctrl+a");
  hand.desktop.xdotool_seen("type b");
  hand.act("key Return");
  CHECK(wait_until([&] { return fs::exists(hand.desktop.folder / "b.viete"); }));
  hand.quit();
}

TEST_CASE("f11_fills_the_screen_and_gives_the_window_its_size_back" * doctest::test_suite(test::if_present)) {
  if (test::no_desktop()) return;
  RealSession hand(1);
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
      scene::read_preferences(hand.desktop.folder / "state" / "viete" / "remembered.json");
  CHECK(preferences.window == small);
}
