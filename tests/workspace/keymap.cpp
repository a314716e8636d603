#include "workspace/keymap.h"

#include <doctest/doctest.h>

#include <set>

#include "workspace/command.h"

using namespace viete::workspace;

namespace {

Shortcuts keys_of(const Keymap& keymap, std::string_view command) {
  return keymap.of(*find_command(command));
}

}  // namespace

TEST_CASE("every_key_is_written_and_read_back") {
  for (const char* written :
       {"Ctrl+Shift+Z", "Num +", "Ctrl+Num -", "Alt+.", "F11", "Shift+Alt+A", "Num .", "Esc"}) {
    const auto shortcut = shortcut_of(written);
    REQUIRE_MESSAGE(shortcut, written);
    CHECK(text(*shortcut) == written);
  }
  CHECK(shortcut_of("shift+CTRL+z") == shortcut_of("Ctrl+Shift+Z"));
  CHECK(shortcut_of("") == Shortcut{});
  for (const char* wrong : {"Hyper+A", "Ctrl+", "F99", "AB", "\xC3\xA9", "+", "Ctrl++A"})
    CHECK_MESSAGE(!shortcut_of(wrong), wrong);
}

TEST_CASE("in_every_preset_a_key_runs_one_command") {
  for (std::size_t i = 0; i < choices(KeyPreset{}).size(); ++i) {
    Keymap keymap;
    keymap.set_preset(static_cast<KeyPreset>(i));
    CHECK(text(keys_of(keymap, "view_home").first) == "Home");
    for (const Command& command : commands()) {
      const Shortcuts keys = keymap.of(command);
      for (const Shortcut& key : {keys.first, keys.second})
        for (const Command* other : keymap.commands_of(key))
          CHECK_MESSAGE((other == &command || shares_keys(other->name, command.name)), command.name, " and ",
                        other->name, " by ", text(key), " in ", choices(KeyPreset{})[i].word);
    }
  }
}

TEST_CASE("a_preset_key_has_its_original_function_or_none") {
  const auto runs = [](KeyPreset preset, const char* written) {
    Keymap keymap;
    keymap.set_preset(preset);
    std::set<std::string_view> names;
    for (const Command* command : keymap.commands_of(*shortcut_of(written))) names.insert(command->name);
    return names;
  };
  using Names = std::set<std::string_view>;
  struct Expected {
    KeyPreset preset;
    const char* key;
    Names names;
  };
  const Expected all[] = {
      {KeyPreset::blender, "Ctrl+R", {}},  // loop cut in Blender
      {KeyPreset::blender, "G", {"grab"}},
      {KeyPreset::blender, "Alt+A", {"select_none"}},
      {KeyPreset::blender, "Ctrl+Z", {"undo"}},
      {KeyPreset::blender, "T", {"toggle_tools"}},
      {KeyPreset::blender, "N", {"toggle_methods"}},
      {KeyPreset::blender, "P", {}},
      {KeyPreset::blender, "Ctrl+B", {}},  // bevel in Blender
      {KeyPreset::blender, "Shift+H", {"hide_others"}},
      {KeyPreset::blender, "F11", {}},
      {KeyPreset::maya, "A", {"frame_all"}},
      {KeyPreset::maya, "Insert", {"place_pivot"}},
      {KeyPreset::maya, "F9", {"select_vertices"}},
      {KeyPreset::maya, "F10", {"select_edges"}},
      {KeyPreset::maya, "F11", {"select_faces"}},
      {KeyPreset::maya, "Ctrl+E", {"extrude_faces"}},
      {KeyPreset::maya, "X", {}},  // snap to grid in Maya
      {KeyPreset::maya, "1", {}},
      {KeyPreset::viete, "Ctrl+R", {"reset_pose"}},
      {KeyPreset::viete, "T", {"toggle_theme"}},
      {KeyPreset::viete, "F11", {"toggle_full_screen"}},
      {KeyPreset::viewer, "G", {"toggle_grid"}},
  };
  for (const auto& [preset, key, names] : all)
    CHECK_MESSAGE(runs(preset, key) == names, key, " in ", choices(KeyPreset{})[std::size_t(preset)].word);
}

TEST_CASE("a_changed_key_is_taken_from_others_and_given_back") {
  Keymap keymap;
  const Keymap fresh;
  keymap.change("toggle_grid", {key('F'), true});
  CHECK(text(keys_of(keymap, "toggle_grid").first) == "Ctrl+F");
  keymap.change("toggle_axes", {key('G')});
  keymap.change("toggle_ghost", {key('G')});  // toggle_axes loses the key and does not get its default
  CHECK(text(keys_of(keymap, "toggle_ghost").first) == "G");
  CHECK(text(keys_of(keymap, "toggle_axes").first).empty());
  keymap.change("undo", {});
  CHECK(text(keys_of(keymap, "undo").first).empty());
  keymap.set_preset(KeyPreset::blender);
  CHECK(text(keys_of(keymap, "toggle_ghost").first) == "G");  // a preset keeps changes by the user
  CHECK(text(keys_of(keymap, "grab").first).empty());
  keymap.take_back("toggle_ghost");
  CHECK(text(keys_of(keymap, "grab").first) == "G");
  keymap.put({});
  keymap.set_preset(KeyPreset::viete);
  CHECK(keymap == fresh);
  CHECK(text(keys_of(keymap, "undo").first) == "Ctrl+Z");
}
