// The keys of all keymaps, the list of keys, and help about keys and mouse.

#include "support/text.h"
#include "ui/panel_driver.h"

using namespace viete;
using test::PanelDriver;

namespace {

void choose_preset(PanelDriver& d, workspace::KeyPreset preset) {
  d.run(("keys_" + std::string(workspace::entry_of(preset).word)).c_str());
}

workspace::Keymap& keymap(PanelDriver& d) {
  return d.workspace().preferences.keymap;
}

std::string key_of(PanelDriver& d, const char* command) {
  return workspace::text(keymap(d).of(*workspace::find_command(command)).first);
}

void open_list(PanelDriver& d) {
  d.choose("menu/Help", "menu/help");
  REQUIRE(d.workspace().panels.key_list.open);
}

bool says(const std::vector<ui::MouseLine>& lines, const std::string& words) {
  return std::ranges::any_of(lines, [&](const ui::MouseLine& line) {
    return (line.action + ": " + line.what).find(words) != std::string::npos;
  });
}

}  // namespace

TEST_CASE("the_key_list_changes_a_key_and_names_the_command_that_loses_it") {
  PanelDriver d;
  open_list(d);
  d.click("keys_text");
  d.type("wireframe");
  d.click("key/toggle_wireframe");
  REQUIRE(d.workspace().view.interaction.setting_key == "toggle_wireframe");
  const bool grid = d.workspace().view.options.grid;
  d.press_key('G');
  CHECK(d.workspace().panels.key_list.open);
  CHECK(d.workspace().panels.key_list.typed == "wireframe");
  CHECK(d.workspace().view.options.grid == grid);
  CHECK(key_of(d, "toggle_wireframe") == "G");
  CHECK(key_of(d, "toggle_grid").empty());
  CHECK(test::mentions(d.last_message(), "It was taken from \"Show grid\""));
  d.frame(2);
  d.click("key/toggle_wireframe/reset");
  CHECK(key_of(d, "toggle_wireframe") == "Shift+W");
  CHECK(key_of(d, "toggle_grid") == "G");
  d.click("close_keys");
  CHECK_FALSE(d.workspace().panels.key_list.open);
  d.press_key('G');
  CHECK(d.workspace().view.options.grid != grid);
}

TEST_CASE("in_the_key_list_esc_leaves_a_key_and_then_the_list_and_delete_removes_a_key") {
  PanelDriver d;
  open_list(d);
  d.click("keys_text");
  d.type("undo");
  d.click("key/undo");
  d.press_key(workspace::Key::escape);
  CHECK(d.workspace().panels.key_list.open);
  CHECK(key_of(d, "undo") == "Ctrl+Z");
  d.click("key/undo");
  d.press_key(workspace::Key::delete_key);
  CHECK(key_of(d, "undo").empty());
  const workspace::Keymap changed = keymap(d);
  d.click("reset_keys");
  CHECK(keymap(d) == workspace::Keymap());
  d.frame();
  d.click("reset_keys");  // restores the changed keys
  CHECK(keymap(d) == changed);
  d.press_key(workspace::Key::escape);
  CHECK_FALSE(d.workspace().panels.key_list.open);
}

TEST_CASE("mouse_help_matches_the_preset") {
  PanelDriver d;
  choose_preset(d, workspace::KeyPreset::viewer);
  CHECK(says(ui::mouse_lines(keymap(d)), "Left drag elsewhere: orbit"));
  CHECK(says(ui::mouse_lines(keymap(d)), "Right drag: pan"));
  CHECK(ui::empty_space_words(keymap(d)).find("on empty space orbits") == 0);
  const auto still = d.workspace().view.camera.pose();
  d.drag({420, 720}, {470, 700});
  const auto turned = d.workspace().view.camera.pose();
  CHECK(turned.yaw != still.yaw);
  d.drag({420, 720}, {470, 700}, 1);
  CHECK(d.workspace().view.camera.pose().yaw == turned.yaw);
  CHECK(d.workspace().view.camera.pose().target != turned.target);
  choose_preset(d, workspace::KeyPreset::maya);
  CHECK(says(ui::mouse_lines(keymap(d)), "Alt+left, middle, right drag: orbit, pan, zoom"));
  choose_preset(d, workspace::KeyPreset::viete);
  CHECK(says(ui::mouse_lines(keymap(d)), "Left drag elsewhere: box select"));
  keymap(d).change("help", {workspace::Key::f7});
  CHECK(ui::key_or_label(keymap(d), "help") == "F7");
  keymap(d).change("help", {});
  CHECK(ui::key_or_label(keymap(d), "help") == "\"Show keys and mouse\"");
}
