// Dialogs get all keys and mouse buttons while they are open.
#include "document/time_edit.h"
#include "ui/panel_driver.h"
#include "ui/widgets.h"
#include "workspace/open_save.h"

using namespace viete;
using test::PanelDriver;

namespace {

// Everything that keys and buttons outside of a dialog could change.
std::string unlocked_state(PanelDriver& d) {
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

struct Dialogs : PanelDriver {
  Dialogs() : PanelDriver(test::ball_workspace(2), {700, 420}) {
    document::set_key(document(), 1);
    document().changed_selection().apply(std::vector<std::uint32_t>{0, 1, 2}, document::SelectMode::replace);
    document().changed_pose().positions[0][0] += 0.5;
    document::set_key(document(), 9);
    run("keep_pose");
  }
  void open(const std::string& dialog) {
    if (dialog == "question") workspace().files.question = workspace::ask_before_discarding(2);
    if (dialog != "question") run(dialog.c_str());
    frame(4);
    REQUIRE(ui::is_popup_open());
    if (has("file_list")) click("file_list");  // the fields lose the focus
    frame(2);
  }
  void close() {
    press_key(workspace::Key::escape);
    auto& w = workspace();
    if (!w.files.question) return;
    const auto* answer = w.jobs.wishes.find<workspace::AnswerQuestion>();
    REQUIRE(answer);
    CHECK(answer->answer == workspace::Answer::cancel);
    w.jobs.wishes = {};
    w.files.question.reset();
    frame(2);
  }
};

constexpr const char* dialogs[] = {"open_model",      "open_cage",  "open_pose",       "import_shapes",
                                   "save_session_as", "save_pose",  "save_model",      "save_cage",
                                   "save_animation",  "question",   "command_palette", "help",
                                   "show_messages",   "preferences"};

}  // namespace

TEST_CASE("the_backspace_that_empties_a_filter_stays_in_the_folder") {
  PanelDriver d;
  d.run("open_model");
  const workspace::FileBrowser& browser = d.workspace().files.browser;
  const std::filesystem::path folder = browser.folder;
  d.type("a");
  CHECK(browser.filter == "a");
  d.press_key(workspace::Key::backspace);
  CHECK(browser.filter.empty());
  CHECK(browser.folder == folder);
  d.press_key(workspace::Key::backspace);
  CHECK(browser.folder == folder.parent_path());
}

TEST_CASE("no_key_of_any_keymap_passes_through_a_dialog") {
  Dialogs scene;
  for (const workspace::Choice& preset : workspace::choices(workspace::KeyPreset{})) {
    scene.run(("keys_" + std::string(preset.word)).c_str());
    const auto keys = keys_of(scene.workspace().preferences.keymap);
    REQUIRE(keys.size() > 50);
    for (const char* dialog : dialogs) {
      scene.open(dialog);
      const std::string before = unlocked_state(scene);
      for (const auto& key : keys) scene.tap(static_cast<int>(key.key), key.ctrl, key.shift, key.alt);
      CHECK_MESSAGE((unlocked_state(scene) == before), preset.word, ", ", dialog);
      scene.close();
    }
    const std::string before = unlocked_state(scene);
    scene.press_key(workspace::Key::delete_key);  // the keys act again
    CHECK((unlocked_state(scene) != before));
    scene.run("undo");
  }
}

TEST_CASE("no_button_passes_through_a_dialog") {
  Dialogs d;
  const glm::vec2 column = d.place_of("keep_pose"), view = d.workspace().view.camera.viewport.origin + 4.0f;
  for (const char* dialog : dialogs) {
    d.open(dialog);
    const std::string before = unlocked_state(d);
    const bool closes = std::string_view(dialog) == "command_palette";  // by a click beside it
    for (const int button : {0, 1, 2})
      for (const glm::vec2& at : {column, view}) {
        d.drag(at, at + glm::vec2(20, 9), button);
        d.wheel(1);
        CHECK_MESSAGE((unlocked_state(d) == before), dialog, ", button ", button);
        if (closes) {
          d.close();
          d.open(dialog);
        }
      }
    d.close();
  }
}
