#include "workspace/keymap.h"

#include <array>

#include "workspace/command.h"

namespace viete::workspace {

namespace {

struct PresetKeys {
  std::string_view command;
  Shortcut first, second;
};

constexpr Shortcut plain(char c) {
  return {key(c)};
}
constexpr Shortcut ctrl(char c) {
  return {key(c), true};
}
constexpr Shortcut shift(char c) {
  return {key(c), false, true};
}
constexpr Shortcut alt(char c) {
  return {key(c), false, false, true};
}

// The keys of the preset Blender that differ from the preset Viete.
constexpr auto blender_keys = std::to_array<PresetKeys>({
    {"grab", plain('G'), {}},
    {"grab_rotate", plain('R'), {}},
    {"grab_scale", plain('S'), {}},
    {"select_all", plain('A'), {}},
    {"select_none", alt('A'), {}},
    {"select_box", plain('B'), {}},
    {"select_brush", plain('C'), {}},
    {"hide_selected", plain('H'), {}},
    {"show_hidden", alt('H'), {}},
    {"select_more", {Key::pad_plus, true}, {}},
    {"select_less", {Key::pad_minus, true}, {}},
    {"toggle_soft", plain('O'), {}},
    {"hide_others", shift('H'), {}},
    {"next_mirror", ctrl('M'), {}},
    {"bend", shift('W'), {}},
    {"tool_select", plain('W'), {}},
    {"frame_selection", {Key::pad_point}, {}},
    {"reset_selected", alt('G'), {Key::delete_key}},
    {"remove_elements", plain('X'), {Key::delete_key}},
    {"extrude_faces", plain('E'), {}},
    {"merge_vertices", plain('M'), {}},
    {"next_shading", plain('Z'), {}},
    {"toggle_select_visible", alt('Z'), {}},
    {"toggle_wireframe", {key('Z'), false, true, true}, {}},
    {"command_palette", {Key::f3}, {}},
    {"toggle_tools", plain('T'), {}},
    {"toggle_methods", plain('N'), {}},
    {"toggle_panels", {Key::space, true}, {}},
    {"redo", {key('Z'), true, true}, {}},
    {"delete_keys", plain('X'), {Key::delete_key}},
});
// Commands without a key, because Blender uses the key for a function that Viete does not have.
constexpr std::string_view blender_without[] = {
    "place_pivot", "reset_pose",   "restore_leftover", "open_pose",   "save_model",
    "tool_move",   "select_lasso", "method_diag",      "method_sd",   "method_improved_sd",
    "method_fast", "add_probe",    "mirror_probe",     "toggle_z_up", "toggle_full_screen"};

// The keys of the preset Maya that differ from the preset Viete.
constexpr auto maya_keys = std::to_array<PresetKeys>({
    {"frame_all", plain('A'), {}},
    {"frame_selection", plain('F'), {}},
    {"select_all", {key('A'), true, true}, {}},
    {"select_none", {key('D'), false, false, true}, {}},
    {"place_pivot", {Key::insert}, plain('D')},
    {"toggle_soft", plain('B'), {}},
    {"undo", plain('Z'), ctrl('Z')},
    {"redo", shift('Z'), ctrl('Y')},
    {"select_more", {key('.'), false, true}, {}},
    {"select_less", {key(','), false, true}, {}},
    {"select_vertices", {Key::f9}, {}},
    {"select_edges", {Key::f10}, {}},
    {"select_faces", {Key::f11}, {}},
    {"invert_selection", {key('I'), true, true}, {}},
    {"hide_selected", ctrl('H'), {}},
    {"hide_others", alt('H'), {}},
    {"show_hidden", {key('H'), true, true}, {}},
    {"extrude_faces", ctrl('E'), {}},
    {"command_palette", ctrl('K'), {}},
    {"toggle_panels", {Key::space, true}, {}},
    {"toggle_orthographic", {Key::pad5}, {}},
    {"shading_file", plain('6'), {}},
    {"toggle_wireframe", plain('4'), {}},
    {"next_shading", plain('5'), {}},
    {"set_key", plain('S'), {}},
    {"play", alt('V'), {Key::space}},
    {"previous_key", plain(','), {Key::down}},
    {"next_key", plain('.'), {Key::up}},
    {"previous_frame", alt(','), {Key::left}},
    {"next_frame", alt('.'), {Key::right}},
});
constexpr std::string_view maya_without[] = {
    "reset_pose",   "restore_leftover", "screenshot",      "select_linked", "add_probe",
    "mirror_probe", "toggle_model",     "toggle_deformed", "toggle_cage",   "toggle_grid",
    "toggle_axes",  "toggle_ghost",     "toggle_theme",    "toggle_z_up"};

struct PresetChanges {
  std::span<const PresetKeys> keys{};
  std::span<const std::string_view> without{};  // commands without a key
};

PresetChanges changes_of_preset(KeyPreset preset) {
  switch (preset) {
    case KeyPreset::blender: return {blender_keys, blender_without};
    case KeyPreset::maya: return {maya_keys, maya_without};
    case KeyPreset::viete:
    case KeyPreset::viewer: break;
  }
  return {};
}

}  // namespace

std::span<const Choice> choices(KeyPreset) {
  static constexpr Choice all[] = {
      {"viete", "Viete", "Q W E R choose tools, single letters switch the display."},
      {"blender", "Blender",
       "G R S move, rotate and scale; B C A H select and hide; Tab edits the cage; T and N hide columns."},
      {"maya", "Maya",
       "Q W E R choose tools, F9 F10 F11 the element kind; F shows the selection; Alt+drag moves the "
       "camera."},
      {"viewer", "Viewer", "Like Viete, but left drag on empty space orbits the view."}};
  return all;
}

std::string text(const Shortcuts& keys) {
  const std::string first = text(keys.first), second = text(keys.second);
  return first + (first.empty() || second.empty() ? "" : ", ") + second;
}

bool shares_keys(std::string_view command, std::string_view other) {
  // The two commands of each pair apply in different modes, for example during cage editing.
  const auto is_pair = [&](std::string_view a, std::string_view b) {
    return (command == a && other == b) || (command == b && other == a);
  };
  return is_pair("remove_elements", "reset_selected") || is_pair("stop_work", "stop_selecting") ||
         is_pair("delete_keys", "reset_selected") || is_pair("delete_keys", "remove_elements");
}

void Keymap::set_preset(KeyPreset preset) {
  preset_ = preset;
  resolve();
}

void Keymap::change(std::string_view command, const Shortcut& shortcut) {
  changes_[std::string(command)] = shortcut;
  if (shortcut.key != Key::none) {
    for (auto& [name, key] : changes_) {
      if (name != command && key == shortcut && !shares_keys(name, command)) key = {};
    }
  }
  resolve();
}

void Keymap::take_back(std::string_view command) {
  if (const auto found = changes_.find(command); found != changes_.end()) changes_.erase(found);
  resolve();
}

void Keymap::put(Changes changes) {
  changes_ = std::move(changes);
  resolve();
}

Shortcuts Keymap::of(const Command& command) const {
  const auto found = keys_.find(command.name);
  return found == keys_.end() ? Shortcuts{} : found->second;
}

std::vector<const Command*> Keymap::commands_of(const Shortcut& shortcut) const {
  std::vector<const Command*> found;
  if (shortcut.key == Key::none) return found;
  for (const Command& command : commands()) {
    const Shortcuts keys = of(command);
    if (keys.first == shortcut || keys.second == shortcut) found.push_back(&command);
  }
  return found;
}

std::vector<const Command*> Keymap::losers(std::string_view command, const Shortcut& shortcut) const {
  std::vector<const Command*> found = commands_of(shortcut);
  std::erase_if(found, [&](const Command* other) {
    return other->name == command || shares_keys(other->name, command);
  });
  return found;
}

void Keymap::give(std::string_view command, const Shortcuts& shortcuts) {
  const Command* const known = find_command(command);
  if (!known) return;
  for (auto& [name, keys] : keys_) {
    if (shares_keys(name, command)) continue;
    for (Shortcut* own : {&keys.first, &keys.second}) {
      if (own->key != Key::none && (*own == shortcuts.first || *own == shortcuts.second)) *own = {};
    }
  }
  keys_[known->name] = shortcuts;
}

void Keymap::resolve() {
  keys_.clear();
  for (const Command& command : commands()) keys_[command.name] = {command.shortcut, command.alternative};
  const PresetChanges preset = changes_of_preset(preset_);
  for (const auto& [name, first, second] : preset.keys) give(name, {first, second});
  for (const auto name : preset.without) give(name, {});
  for (const auto& [name, shortcut] : changes_) give(name, {shortcut, {}});
}

}  // namespace viete::workspace
