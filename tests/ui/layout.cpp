// Uses columns, menus and the palette by mouse and keys.
#include "ui/panel_driver.h"

using namespace viete;
using test::PanelDriver;

TEST_CASE("dragging_the_inner_edge_of_a_column_makes_it_wider_and_the_view_narrower") {
  PanelDriver d;
  const auto before = d.workspace().view.camera.viewport;
  d.drag({before.origin.x + 3, 60}, {before.origin.x + 83, 60});
  CHECK(d.workspace().view.camera.viewport.origin.x == doctest::Approx(before.origin.x + 80).epsilon(0.02));
  CHECK(d.workspace().view.camera.viewport.size.x < before.size.x - 70);
  const float end = d.workspace().view.camera.viewport.origin.x + d.workspace().view.camera.viewport.size.x;
  d.drag({end - 3, 60}, {end - 43, 60});
  CHECK(d.workspace().preferences.layout.width[1] == doctest::Approx(360).epsilon(0.02));
  CHECK(d.document().selection().empty());
  // A tab folds and unfolds its column.
  for (const bool shown : {false, true}) {
    d.click("tab/methods");
    CHECK(d.is_seen("method_diag") == shown);
    CHECK((d.workspace().view.camera.viewport.size.x > 800) == !shown);
  }
}

TEST_CASE("a_menu_runs_a_command") {
  PanelDriver d;
  CHECK(d.workspace().view.options.grid);
  d.choose("menu/View", "menu/toggle_grid");
  CHECK_FALSE(d.workspace().view.options.grid);
  d.frame(2);
  CHECK_FALSE(d.recorder().find("menu/toggle_grid"));  // the menu is closed again
  d.choose("menu/Deform", "menu/method_sd");
  CHECK(d.document().method() == sym3::Method::sd);
}

TEST_CASE("a_right_click_opens_a_menu_and_a_right_drag_orbits") {
  PanelDriver d;
  const auto camera = d.workspace().view.camera.pose();
  const auto v = d.free_vertex();
  d.click(d.vertex(v), 1);
  CHECK(d.document().selection().contains(v));
  CHECK(d.workspace().view.camera.pose() == camera);
  d.click("menu/select_all");
  CHECK(d.document().selection().size() == d.document().pose().positions.size());
  d.frame(2);
  const auto& port = d.workspace().view.camera.viewport;
  const glm::vec2 empty = port.origin + glm::vec2(0.5f * port.size.x, port.size.y - 70);
  d.drag(empty, empty + glm::vec2(40, 5), 1);
  CHECK_FALSE(d.workspace().view.camera.pose() == camera);
  CHECK_FALSE(d.recorder().find("menu/select_all"));
  // The menu adds a probe at the place where the menu was opened.
  d.workspace().view.options.cage = false;
  d.click(port.origin + glm::vec2(0.5f, 0.62f) * port.size, 1);
  d.click("menu/add_probe");
  CHECK(d.document().probes().all.size() == 1);
}

TEST_CASE("the_palette_runs_commands_by_letters_arrow_keys_and_enter") {
  PanelDriver d(workspace::Workspace{});
  d.frame(3);
  d.press_key(workspace::key('K'), true);
  d.type("theme");
  CHECK(d.is_seen("palette/toggle_theme"));
  const bool dark = d.workspace().view.options.dark;
  d.press_key(workspace::Key::enter);
  CHECK(d.workspace().view.options.dark != dark);
  d.frame(2);
  CHECK_FALSE(d.recorder().find("palette_text"));
  d.press_key(workspace::Key::f3);
  d.type("save");
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
  PanelDriver d;
  d.frame(3);
  const auto before = *d.recorder().find("open_model");
  d.workspace().messages.error("A message that stays");
  d.frame(3);
  const auto after = *d.recorder().find("open_model");
  CHECK(before.y0 == after.y0);
  CHECK(d.is_seen("toast/0"));
}
