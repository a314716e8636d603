// The real window on a virtual display, with a real mouse: equals the offscreen program to the pixel.
#include <chrono>
#include <thread>

#include "program/desktop.h"
#include "program/driver.h"
#include "scene/workspace/pointer.h"
#include "support/folder.h"
#include "support/pictures.h"

using namespace viete;
using test::Child;
using test::Desktop;
using test::Driver;
using test::f12_keycode;
using test::wait_until;
namespace fs = std::filesystem;

namespace {

// Columns, bars and the tool strip, whose text differs in font.
void cut_panels(render::Image& image) {
  constexpr int left = 384, right = 320, top = 40, bottom = 26;
  for (int y = 0; y < image.height; ++y) {
    const bool bar = y >= image.height - bottom || y < top;
    const auto row = image.rgba.begin() + 4 * std::ptrdiff_t(y) * image.width;
    std::fill_n(row, 4 * (bar ? image.width : left), std::uint8_t{0});
    std::fill_n(row + 4 * (image.width - right), 4 * right, std::uint8_t{0});
  }
}

// The same smoothness as a cached picture at rest.
app::ViewerOptions as_in_the_window() {
  auto options = Driver::default_options();
  options.size = {1440, 900};
  options.samples = 4;
  return options;
}

}  // namespace

TEST_CASE("a_real_mouse_in_a_real_window_puts_the_mesh_where_the_offscreen_program_puts_it" *
          doctest::test_suite(test::if_present)) {
  if (test::no_desktop()) return;
  Driver d(as_in_the_window(), test::with_pixels);
  d.document().scheme = deform::default_scheme();
  d.open_dragon("", test::bundled_dragon);
  d.frame();
  scene::frame_all(d.workspace(), false);
  d.settle();
  const glm::ivec2 from(glm::round(d.vertex(d.free_vertex()))), to = from + glm::ivec2(72, -56);

  Desktop desktop;
  Child viewer(desktop.viete(""), desktop.folder / "viete.log");
  desktop.xdotool("search --sync --onlyvisible --name dragon");
  desktop.rest();
  desktop.drag(from, to);
  desktop.xdotool("mousemove 1430 20");
  desktop.rest();
  desktop.xdotool(std::string("key ") + f12_keycode);
  REQUIRE(wait_until([&] { return desktop.screenshot().has_value(); }));
  auto real = test::read_png(*desktop.screenshot());
  desktop.xdotool("key ctrl+q");
  REQUIRE(wait_until([&] { return viewer.finished(); }));
  CHECK(viewer.exit_code() == 0);

  d.drag(from, to);
  d.move({1430, 20});
  d.frame(3);
  auto offscreen = d.picture();
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

TEST_CASE("the_gizmo_and_typed_angles_work_in_a_real_window_as_offscreen" *
          doctest::test_suite(test::if_present)) {
  if (test::no_desktop()) return;
  Driver d(as_in_the_window(), test::with_pixels);
  d.document().scheme = deform::default_scheme();
  d.open_dragon("", test::bundled_dragon);
  d.frame();
  scene::frame_all(d.workspace(), false);
  d.settle();
  d.workspace().document.selection.select_all(d.document().pose.positions.size());
  const auto gizmo = *scene::gizmo_of(d.workspace());
  d.workspace().document.selection.clear();
  const glm::ivec2 tip(glm::round(gizmo.arms[1].tip)), end = tip + glm::ivec2(20, -60);
  Desktop desktop;
  Child viewer("env DISPLAY=" + desktop.display + " WAYLAND_DISPLAY= sh -c 'cd \"" + desktop.folder.string() +
                   "\" && exec \"" + test::build_dir().string() + "/viete\" --scale 1'",
               desktop.folder / "viete.log");
  desktop.xdotool("search --sync --onlyvisible --name dragon");
  desktop.rest();
  d.move({1000, 20});
  d.press_key('A');
  d.drag(tip, end);
  d.press_key('E');
  const glm::ivec2 ring(
      glm::round(scene::gizmo_of(d.workspace())->center + glm::vec2(scene::gizmo_view_ring, 0)));
  d.press_and_move(ring, ring + glm::ivec2(0, -24));
  d.type("30");
  d.press_key(scene::Key::enter);
  d.button(0, false);
  d.move({1430, 20});
  d.frame(3);

  const auto at = [](glm::ivec2 p) { return std::to_string(p.x) + " " + std::to_string(p.y); };
  desktop.xdotool("mousemove 1000 20");
  desktop.xdotool("key a");
  desktop.drag(tip, end);
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

  auto offscreen = d.picture();
  REQUIRE(real.width == offscreen.width);
  cut_panels(real);
  cut_panels(offscreen);
  const double differing = test::difference(real, offscreen, 2);
  if (differing > 0.001) {
    render::write_png(test::build_dir() / "window-gizmo-real.png", real);
    render::write_png(test::build_dir() / "window-gizmo-offscreen.png", offscreen);
  }
  CHECK(differing <= 0.001);
}

TEST_CASE("a_window_closes_at_once_when_edits_are_kept_and_asks_when_they_are_not" *
          doctest::test_suite(test::if_present)) {
  if (test::no_desktop()) return;
  Driver d(as_in_the_window(), test::with_pixels);
  d.document().scheme = deform::default_scheme();
  d.open_dragon("", test::bundled_dragon);
  d.frame();
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
      CHECK(test::file_bytes(log).find("unsaved edits were saved") != std::string::npos);
      continue;
    }
    desktop.rest(at_work);
    CHECK_FALSE(viewer.finished());
    desktop.xdotool_seen("key Escape");  // dismisses the question each time
    const std::string again_at_work = desktop.screen();
    viewer.terminate();
    desktop.rest(again_at_work);
    CHECK_FALSE(viewer.finished());
    desktop.xdotool_seen("key Escape");
    desktop.xdotool_seen("key ctrl+q");
    CHECK_FALSE(viewer.finished());
    desktop.xdotool("key Left");
    desktop.xdotool("key Return");  // close without saving
    REQUIRE(wait_until([&] { return viewer.finished(); }));
    CHECK(viewer.exit_code() == 0);
    CHECK(test::file_bytes(log).find("kept") == std::string::npos);
  }
}
