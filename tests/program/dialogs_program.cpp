// Dialogs get all keys and mouse buttons while they are open.
#include "document/edit.h"
#include "document/time_edit.h"
#include "program/small_scene.h"
#include "ui/widgets.h"
#include "workspace/playing.h"
#include "workspace/saving.h"

using namespace viete;
using test::Driver;

namespace {

// Everything that keys and buttons outside of a dialog could change.
std::string state(Driver& d) {
  workspace::Workspace& w = d.workspace();
  std::string text = files::session_text(workspace::session_of(w), "/session.viete");
  for (const std::uint32_t i : w.document.selection().indices()) text += std::to_string(i) + " ";
  return text + std::to_string(static_cast<int>(w.view.tool)) + std::to_string(w.playback.playing) +
         std::to_string(w.view.interaction.grab.has_value()) + std::to_string(w.view.options.panels) +
         std::to_string(!w.jobs.wishes.empty()) + std::to_string(w.document.history().can_redo()) +
         w.document.history().undo_label();
}

std::vector<workspace::Shortcut> keys_of(const workspace::Keymap& keymap) {
  std::vector<workspace::Shortcut> keys;
  for (const workspace::Command& command : workspace::commands())
    for (const auto& key : {keymap.of(command).first, keymap.of(command).second}) {
      using workspace::Key;
      // A dialog confirms by Enter and closes by Esc.
      const bool used = key.key == Key::enter || key.key == Key::pad_enter || key.key == Key::escape;
      if (!used && key.key != Key::none) keys.push_back(key);
    }
  return keys;
}

struct Dialogs : test::SmallScene {
  Dialogs() {
    document::set_key(d.document(), 1);
    d.document().changed_selection().apply(std::vector<std::uint32_t>{0, 1, 2},
                                           document::SelectMode::replace);
    d.document().changed_pose().positions[0][0] += 0.5;
    document::set_key(d.document(), 9);
    d.run("keep_pose");
    d.settle();
  }
  void open(const std::string& dialog) {
    if (dialog == "question") d.workspace().files.question = workspace::ask_before_discarding(2);
    if (dialog != "question") d.run(dialog.c_str());
    d.frame(4);
    REQUIRE(ui::is_popup_open());
    if (d.viewer().recorder().find("file_list")) d.click("file_list");  // the fields lose the focus
    d.frame(2);
  }
  void close() {
    d.press_key(workspace::Key::escape);
    d.frame(2);
  }
};

constexpr const char* dialogs[] = {"open_model",      "open_cage",  "open_pose",       "import_shapes",
                                   "save_session_as", "save_pose",  "save_model",      "save_cage",
                                   "save_animation",  "question",   "command_palette", "help",
                                   "show_messages",   "preferences"};

}  // namespace

TEST_CASE("the_backspace_that_empties_a_filter_stays_in_the_folder") {
  Driver d;
  d.run("open_model");
  d.frame(3);
  const workspace::FileBrowser& browser = d.workspace().files.browser;
  const fs::path folder = browser.folder;
  d.type("a");
  CHECK(browser.filter == "a");
  d.press_key(workspace::Key::backspace);
  d.frame(3);
  CHECK(browser.filter.empty());
  CHECK(browser.folder == folder);
  d.press_key(workspace::Key::backspace);
  d.frame(3);
  CHECK(browser.folder == folder.parent_path());
}

TEST_CASE("no_key_of_any_keymap_passes_through_a_dialog") {
  Dialogs scene;
  for (const workspace::Choice& preset : workspace::choices(workspace::KeyPreset{})) {
    scene.d.run(("keys_" + std::string(preset.word)).c_str());
    const auto keys = keys_of(scene.d.workspace().preferences.keymap);
    REQUIRE(keys.size() > 50);
    for (const char* dialog : dialogs) {
      scene.open(dialog);
      const std::string before = state(scene.d);
      for (const auto& key : keys) scene.d.press_key(key.key, key.ctrl, key.shift, key.alt);
      CHECK_MESSAGE(state(scene.d) == before, preset.word, ", ", dialog);
      scene.close();
    }
    const std::string before = state(scene.d);
    scene.d.press_key(workspace::Key::delete_key);  // the keys act again
    CHECK(state(scene.d) != before);
    scene.d.run("undo");
  }
}

TEST_CASE("no_button_passes_through_a_dialog") {
  Dialogs scene;
  Driver& d = scene.d;
  const glm::vec2 column = d.place_of("keep_pose"), view = d.workspace().view.viewport.origin + 4.0f;
  for (const char* dialog : dialogs) {
    scene.open(dialog);
    const std::string before = state(d);
    const bool closes = std::string_view(dialog) == "command_palette";  // by a click beside it
    for (const int button : {0, 1, 2}) {
      for (const glm::vec2& at : {column, view}) {
        d.drag(at, at + glm::vec2(20, 9), button);
        d.wheel(1);
        CHECK_MESSAGE(state(d) == before, dialog, ", button ", button);
        if (closes) {
          scene.close();
          scene.open(dialog);
        }
      }
    }
    scene.close();
  }
}

TEST_CASE("typing_in_a_file_list_filters_the_list") {
  Dialogs scene;
  Driver& d = scene.d;
  workspace::FileBrowser& browser = d.workspace().files.browser;
  for (const char* dialog : {"open_cage", "save_model"}) {
    CAPTURE(dialog);
    scene.open(dialog);
    d.type("ca");
    d.type("ge");
    CHECK(browser.filter == "cage");
    REQUIRE(workspace::shown(browser).size() == 1);
    d.type("\xC3\xA9x");
    CHECK(workspace::shown(browser).empty());
    const std::string name = browser.path;
    d.press_key(workspace::Key::enter);  // must not save under the proposed name
    d.frame(2);
    CHECK(browser.open);
    CHECK(std::filesystem::exists(name) == !browser.saves());
    for (int i = 0; i < 2; ++i) d.press_key(workspace::Key::backspace);
    CHECK(browser.filter == "cage");
    for (int i = 0; i < 4; ++i) d.press_key(workspace::Key::backspace);
    CHECK(browser.filter.empty());
    CHECK(browser.folder == std::filesystem::weakly_canonical(scene.folder.path()));
    scene.close();
  }
}

TEST_CASE("a_wrong_path_in_the_filter_is_reported_below_the_filter_and_the_path_row_stays") {
  Dialogs scene;
  Driver& d = scene.d;
  const workspace::FileBrowser& browser = d.workspace().files.browser;
  scene.open("open_cage");
  const std::string path = browser.path;
  d.type("/no/such.obj");
  d.press_key(workspace::Key::enter);
  d.frame(2);
  CHECK(d.viewer().recorder().find("filter_problem"));
  CHECK_FALSE(d.viewer().recorder().find("file_problem"));
  CHECK(browser.path == path);
  CHECK(browser.filter == "/no/such.obj");
  d.type("x");
  d.frame(2);
  CHECK(browser.filter_problem.empty());
  scene.close();
}

TEST_CASE("another_scale_applies_at_the_next_frame") {
  Driver d;
  d.frame(3);
  d.viewer().resize({1280, 800}, 2);
  d.frame();
  CHECK(ImGui::GetIO().FontGlobalScale == 0.5f);
  CHECK(ImGui::GetIO().DisplayFramebufferScale.x == 2);
  CHECK(d.viewer().device_size() == glm::ivec2(2560, 1600));
}

TEST_CASE("preferences_change_scale_motion_autosave_and_list_recovered_edits") {
  const test::TemporaryFolder folder;
  Driver d;
  workspace::Workspace& w = d.workspace();
  w.recovery.files = {{folder / "a.viete", "first.obj", 1000, folder.path()},
                      {folder / "b.viete", "second.obj", 500, folder.path(), true}};  // restored once
  d.run("preferences");
  d.frame(3);
  d.choose("preferences/scale", "preferences/scale/3");
  CHECK(w.preferences.scale == 1.5f);
  d.choose("preferences/scale", "preferences/scale/0");
  CHECK_FALSE(w.preferences.scale);
  d.choose("preferences/motion", "preferences/motion/2");
  CHECK(w.preferences.coarse_motion == false);
  d.click("preferences/autosave");
  CHECK_FALSE(w.preferences.autosave);
  d.click("preferences/restore/1");
  CHECK_FALSE(w.panels.show_preferences);
  d.settle();
  REQUIRE_FALSE(w.messages.all().empty());
  CHECK(w.messages.all().back().text.find("b.viete") != std::string::npos);  // this file is missing
}
