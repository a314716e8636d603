// Keys of every preset, the key list, and the help for keys and mouse.
#include <algorithm>
#include <cstdlib>

#include "program/driver.h"
#include "scene/workspace/menus.h"
#include "ui/help_overlay.h"

using namespace viete;
using test::Driver;

namespace {

void choose_preset(Driver& d, scene::KeyPreset preset) {
  const auto& entry = scene::entry_of(preset);
  scene::find_command("keys_" + std::string(entry.word))->run(d.workspace());
}

constexpr scene::KeyPreset presets[] = {scene::KeyPreset::viete, scene::KeyPreset::blender,
                                        scene::KeyPreset::maya, scene::KeyPreset::viewer};

scene::Keymap& keymap(Driver& d) {
  return d.workspace().preferences.keymap;
}

std::string key_of(Driver& d, const char* command) {
  return scene::text(keymap(d).of(*scene::find_command(command)).first);
}

void open_list(Driver& d) {
  d.click("menu/Help");
  d.frame(2);
  d.click("menu/edit_keys");
  d.frame(2);
  REQUIRE(d.workspace().key_list.open);
}

void keep_picture(Driver& d, const char* name) {
  if (const char* folder = std::getenv("VIETE_PICTURES"))
    render::write_png(std::filesystem::path(folder) / name, d.picture());
}

bool says(const std::vector<ui::MouseLine>& lines, const std::string& words) {
  return std::ranges::any_of(lines, [&](const ui::MouseLine& line) {
    return (line.action + ": " + line.what).find(words) != std::string::npos;
  });
}

}  // namespace

TEST_CASE("in_every_preset_the_home_key_does_what_the_home_button_does") {
  Driver d;
  d.open_dragon();
  const auto wander = [&] {
    d.drag({800, 100}, {900, 160}, 2);
    d.move({800, 300});
    d.wheel(2);
    d.settle();
  };
  wander();
  d.run("view_home");
  d.settle();
  const auto home = d.workspace().camera.pose();
  for (const auto preset : presets) {
    CAPTURE(scene::entry_of(preset).word);
    choose_preset(d, preset);
    wander();
    REQUIRE(d.workspace().camera.pose().yaw != home.yaw);
    d.press_key(scene::Key::home);
    d.settle();
    CHECK(d.workspace().camera.pose() == home);
  }
}

TEST_CASE("f11_asks_for_the_whole_screen_and_back_but_where_hands_mean_something_else") {
  Driver d;
  d.open_dragon();
  for (const auto preset : {scene::KeyPreset::viete, scene::KeyPreset::viewer}) {
    choose_preset(d, preset);
    d.press_key(scene::Key::f11);
    CHECK(d.workspace().full_screen);
    CHECK(scene::find_command("toggle_full_screen")->on(d.workspace()));
    d.press_key(scene::Key::f11);
    CHECK_FALSE(d.workspace().full_screen);
  }
}

TEST_CASE("the_key_list_changes_a_key_and_names_the_command_that_loses_it") {
  Driver d;
  d.open_dragon();
  open_list(d);
  d.click("keys_text");
  d.type("wireframe");
  d.click("key/toggle_wireframe");
  d.frame();
  REQUIRE(d.workspace().interaction.setting_key == "toggle_wireframe");
  keep_picture(d, "key_list_waiting.png");
  const bool grid = d.workspace().view.grid;
  d.press_key('G');
  CHECK(d.workspace().key_list.open);
  CHECK(d.workspace().key_list.typed == "wireframe");
  CHECK(d.workspace().view.grid == grid);
  CHECK(key_of(d, "toggle_wireframe") == "G");
  CHECK(key_of(d, "toggle_grid").empty());
  CHECK(d.workspace().messages.all().back().text.find("It was taken from \"Show grid\"") !=
        std::string::npos);
  d.frame(2);
  keep_picture(d, "key_list.png");
  d.click("key/toggle_wireframe/reset");
  CHECK(key_of(d, "toggle_wireframe") == "Shift+W");
  CHECK(key_of(d, "toggle_grid") == "G");
  d.click("close_keys");
  d.frame(2);
  CHECK_FALSE(d.workspace().key_list.open);
  d.press_key('G');
  CHECK(d.workspace().view.grid != grid);
}

TEST_CASE("in_the_list_of_keys_esc_leaves_a_key_and_then_the_list_and_delete_takes_one_away") {
  Driver d;
  d.open_dragon();
  open_list(d);
  d.click("keys_text");
  d.type("undo");
  d.click("key/undo");
  d.frame();
  d.press_key(scene::Key::escape);
  CHECK(d.workspace().key_list.open);
  CHECK(key_of(d, "undo") == "Ctrl+Z");
  d.click("key/undo");
  d.frame();
  d.press_key(scene::Key::delete_key);
  CHECK(key_of(d, "undo").empty());
  d.frame();
  d.press_key(scene::Key::escape);
  d.frame();
  CHECK_FALSE(d.workspace().key_list.open);
}

TEST_CASE("all_changes_of_keys_are_taken_back_at_once_and_brought_back") {
  Driver d;
  d.open_dragon();
  keymap(d).change("undo", {scene::key('U'), true});
  keymap(d).change("toggle_grid", {scene::Key::f7});
  const scene::Keymap changed = keymap(d);
  open_list(d);
  keep_picture(d, "key_list_all.png");
  d.click("reset_keys");
  CHECK(keymap(d) == scene::Keymap());
  d.frame();
  d.click("reset_keys");
  CHECK(keymap(d) == changed);
  d.click("keys_blender");
  CHECK(keymap(d).preset() == scene::KeyPreset::blender);
  CHECK(key_of(d, "undo") == "Ctrl+U");
}

TEST_CASE("mouse_help_matches_the_preset") {
  Driver d;
  d.open_dragon();
  choose_preset(d, scene::KeyPreset::viewer);
  CHECK(says(ui::mouse_lines(keymap(d)), "Left drag elsewhere: orbit"));
  CHECK(says(ui::mouse_lines(keymap(d)), "Right drag: pan"));
  CHECK(ui::empty_space_words(keymap(d)).find("on empty space orbits") == 0);
  const auto still = d.workspace().camera.pose();
  d.drag({420, 720}, {470, 700});
  CHECK(d.workspace().camera.pose().yaw != still.yaw);
  const auto turned = d.workspace().camera.pose();
  d.drag({420, 720}, {470, 700}, 1);
  CHECK(d.workspace().camera.pose().yaw == turned.yaw);
  CHECK(d.workspace().camera.pose().target != turned.target);
  choose_preset(d, scene::KeyPreset::maya);
  CHECK(says(ui::mouse_lines(keymap(d)), "Alt+left, middle, right drag: orbit, pan, zoom"));
  choose_preset(d, scene::KeyPreset::viete);
  CHECK(says(ui::mouse_lines(keymap(d)), "Left drag elsewhere: box select"));
  keymap(d).change("help", {scene::Key::f7});
  CHECK(ui::key_or_label(keymap(d), "help") == "F7");
  keymap(d).change("help", {});
  CHECK(ui::key_or_label(keymap(d), "help") == "\"Show keys and mouse\"");
  for (const auto preset : presets) {
    choose_preset(d, preset);
    scene::find_command("help")->run(d.workspace());
    d.frame(3);
    keep_picture(d, ("help_" + std::string(scene::entry_of(preset).word) + ".png").c_str());
    d.press_key(scene::Key::escape);
    CHECK_FALSE(d.workspace().view.help);
  }
}
