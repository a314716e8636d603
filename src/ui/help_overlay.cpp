#include "ui/help_overlay.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "scene/workspace/command.h"
#include "scene/workspace/menus.h"
#include "ui/imgui_bridge.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

void add_looking(const scene::Keymap& keymap, std::vector<MouseLine>& lines) {
  if (keymap.left_orbits()) {
    lines.push_back({"Middle or Alt+left drag", "orbit; with Shift pan, with Ctrl zoom"});
    lines.push_back({"Right drag", "pan"});
  } else if (keymap.alt_moves_camera()) {
    lines.push_back({"Alt+left, middle, right drag", "orbit, pan, zoom"});
    lines.push_back({"Middle or right drag", "orbit; with Shift pan, with Ctrl zoom"});
  } else {
    lines.push_back({"Middle, right or Alt+left drag", "orbit; with Shift pan, with Ctrl zoom"});
  }
  lines.push_back({"Wheel", "zoom to the cursor"});
  lines.push_back({"Double click", "orbit about this point"});
}

}  // namespace

std::string key_or_label(const scene::Keymap& keymap, std::string_view name) {
  const scene::Command& command = *scene::find_command(name);
  const std::string key = scene::text(keymap.of(command).first);
  return key.empty() ? '"' + std::string(command.label) + '"' : key;
}

std::vector<MouseLine> mouse_lines(const scene::Keymap& keymap) {
  std::vector<MouseLine> lines = {
      {"Left click", "select a vertex, edge, face or probe (Shift adds, Ctrl removes)"},
      {"Left drag on it", "move the selection (select faces and dense vertices first)"}};
  if (keymap.left_orbits()) {
    lines.push_back({"Left drag elsewhere", "orbit; box select after " + key_or_label(keymap, "select_box") +
                                                ", with Shift or Ctrl"});
  } else {
    lines.push_back({"Left drag elsewhere", "box select; with Shift (add) or Ctrl (remove) start anywhere"});
  }
  lines.push_back({"Left drag on a handle", "move, rotate or scale along its axis"});
  lines.push_back({"Ctrl, Shift while dragging", "snap to steps; move at a tenth of the speed"});
  lines.push_back({"X Y Z, digits, Enter", "while dragging: axis (Shift: plane), amount, confirm"});
  lines.push_back({"Esc or right button", "cancel the drag"});
  lines.push_back({"Double click on a slider", "type a number (or Ctrl+click)"});
  lines.push_back({"Right click", "context menu"});
  add_looking(keymap, lines);
  return lines;
}

std::string looking_words(const scene::Keymap& keymap) {
  if (keymap.left_orbits()) return "left or middle drag orbits,  right drag pans,  wheel zooms";
  if (keymap.alt_moves_camera()) return "Alt and left drag orbits,  Alt and middle pans,  wheel zooms";
  return "middle or right drag orbits,  Shift pans,  wheel zooms";
}

std::string empty_space_words(const scene::Keymap& keymap) {
  if (!keymap.left_orbits()) return "on empty space selects;  " + looking_words(keymap);
  return "on empty space orbits;  right drag pans,  wheel zooms,  Shift selects with a box";
}

namespace {

// A table row; a heading if the right side is empty.
struct Row {
  std::string left, right;
};
using Rows = std::vector<Row>;

// All keys with the headings of their groups, which are consecutive in the command table: those for files,
// edits and selections, or the others.
void add_commands(const scene::Keymap& keymap, Rows& rows, bool of_hands) {
  std::string_view group;
  for (const auto& command : scene::commands()) {
    const bool is_of_hands = command.group == "File" || command.group == "Edit" || command.group == "Select";
    const std::string keys = scene::text(keymap.of(command));
    if (is_of_hands != of_hands || keys.empty()) continue;
    if (std::exchange(group, command.group) != command.group)
      rows.push_back({std::string(command.group), ""});
    rows.push_back({keys, std::string(command.hint)});
  }
}

Rows hands_rows(const scene::Keymap& keymap) {
  Rows rows{{"Mouse", ""}};
  for (const auto& entry : mouse_lines(keymap)) rows.push_back({entry.action, entry.what});
  add_commands(keymap, rows, true);
  return rows;
}

Rows settings_rows(const scene::Keymap& keymap, const scene::About& about) {
  Rows rows;
  add_commands(keymap, rows, false);
  rows.insert(rows.end(), {{"About", ""},
                           {"Viete", about.version + ", " + about.build},
                           {"Kernel", about.kernel},
                           {"OpenGL", about.renderer}});
  return rows;
}

float width_of(const Rows& rows) {
  float left = 0, right = 0;
  for (const auto& row : rows) {
    left = std::max(left, ImGui::CalcTextSize(row.left.c_str()).x);
    right = std::max(right, ImGui::CalcTextSize(row.right.c_str()).x);
  }
  return left + right + 3 * ImGui::GetStyle().CellPadding.x;
}

void draw_row(const Context& ui, const Row& row) {
  const bool heading = row.right.empty();
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  if (heading) ImGui::Spacing();
  if (heading) ImGui::PushFont(ui.fonts.strong);
  ImGui::TextUnformatted(row.left.c_str());
  if (heading) ImGui::PopFont();
  ImGui::TableNextColumn();
  text_in(ui.colors.faint, row.right);
}

void table(const Context& ui, const char* name, const Rows& rows) {
  ImGui::BeginGroup();
  if (ImGui::BeginTable(name, 2, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoHostExtendX)) {
    for (const auto& row : rows) draw_row(ui, row);
    ImGui::EndTable();
  }
  ImGui::EndGroup();
}

std::string preset_label(const Context& ui) {
  const scene::Keymap& keymap = ui.workspace.preferences.keymap;
  const std::string label(scene::entry_of(keymap.preset()).label);
  return label + (keymap.changes().empty() ? "" : ", changed");
}

}  // namespace

// Two tables side by side, or one below the other if there is no room.
void help_overlay(const Context& ui) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  constexpr float gap = 32;
  const Rows hands = hands_rows(ui.workspace.preferences.keymap),
             settings = settings_rows(ui.workspace.preferences.keymap, ui.workspace.about);
  const float both = width_of(hands) + gap + width_of(settings) + 4 * ImGui::GetStyle().WindowPadding.x;
  const scene::Viewport& v = ui.workspace.viewport;
  const float middle = v.size.x > both ? v.origin.x + 0.5f * v.size.x : 0.5f * display.x;
  ImGui::SetNextWindowSizeConstraints(
      {420, 0}, {display.x - 40, display.y - scene::PanelLayout::menu_height - status_height - 16});
  bool open = true;
  const Window window(
      "Keys and mouse",
      {.at = {middle, 0.5f * (display.y + scene::PanelLayout::menu_height - status_height)}},
      ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize,
      &open);
  note(ui, "Keymap: " + preset_label(ui) + ".  Help, Change keys assigns other keys.");
  table(ui, "hands", hands);
  if (both < display.x - 40) ImGui::SameLine(0, gap);
  table(ui, "settings", settings);
  if (!open) ui.workspace.view.help = false;
}

// The searchable list of commands and keys. A click on a key, then a key press, changes it.

namespace {

constexpr float list_width = 620, keys_width = 150, back_width = 64;

// The preset without user changes.
scene::Keymap plain_preset(const scene::Keymap& keymap) {
  scene::Keymap plain;
  plain.set_preset(keymap.preset());
  return plain;
}

// Explains a missing preset key: the user's changes assign it to another command.
std::string lost_key(const scene::Keymap& keymap, const scene::Keymap& plain, const scene::Command& command) {
  const scene::Shortcut preset = plain.of(command).first;
  const auto losers = keymap.losers(command.name, preset);
  if (losers.empty() || keymap.of(command).first == preset) return "";
  return "\n" + scene::text(preset) + " is used by \"" + std::string(losers.front()->label) + '"';
}

void key_of_command(const Context& ui, const scene::Keymap& plain, const scene::Command& command) {
  scene::Workspace& w = ui.workspace;
  const std::string name(command.name), keys = scene::text(w.preferences.keymap.of(command));
  const bool waits = w.interaction.setting_key == name;
  if (waits) ImGui::PushStyleColor(ImGuiCol_Text, ui.colors.accent);
  const std::string label = (waits ? "Press a key" : keys.empty() ? "-" : keys) + "##" + name;
  if (ImGui::Button(label.c_str(), {keys_width, 0})) w.interaction.setting_key = waits ? "" : name;
  record(ui, "key/" + name);
  if (waits) ImGui::PopStyleColor();
  if (waits || !ImGui::IsItemHovered()) return;
  hint("Click and press the new key. Delete removes it, Esc cancels." +
       lost_key(w.preferences.keymap, plain, command));
}

void give_back(const Context& ui, const scene::Keymap& plain, const scene::Command& command) {
  scene::Keymap& keymap = ui.workspace.preferences.keymap;
  if (!keymap.changes().contains(command.name)) return;
  ImGui::SameLine();
  const std::string preset = scene::text(plain.of(command));
  if (ImGui::Button(("Reset##" + std::string(command.name)).c_str(), {back_width, 0}))
    keymap.take_back(command.name);
  record(ui, "key/" + std::string(command.name) + "/reset");
  hint("Reset to the key of the keymap: " + (preset.empty() ? "none" : preset));
}

void key_row(const Context& ui, const scene::Keymap& plain, const scene::Command& command) {
  const float right = ImGui::GetContentRegionMax().x;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(std::string(command.label).c_str());
  hint(std::string(command.hint));
  ImGui::SameLine(right - keys_width - back_width - ImGui::GetStyle().ItemSpacing.x);
  key_of_command(ui, plain, command);
  give_back(ui, plain, command);
}

void key_heading(const Context& ui, std::string_view title) {
  ImGui::Spacing();
  ImGui::PushFont(ui.fonts.strong);
  ImGui::TextUnformatted(std::string(title).c_str());
  ImGui::PopFont();
}

// Commands of transient questions, which have a button only.
bool is_transient_answer(const Context& ui, const scene::Command& command) {
  return command.passing && scene::text(ui.workspace.preferences.keymap.of(command)).empty();
}

// Grouped by menus, or the matches of the search, best first.
void key_rows(const Context& ui) {
  const std::string& typed = ui.workspace.key_list.typed;
  const scene::Keymap plain = plain_preset(ui.workspace.preferences.keymap);
  if (typed.empty()) {
    for (const scene::Menu& menu : scene::menus()) {
      key_heading(ui, menu.title);
      for (const scene::Command* command : menu.items) {
        if (!is_transient_answer(ui, *command)) key_row(ui, plain, *command);
      }
    }
    return;
  }
  const auto found = scene::find_commands(ui.workspace, typed);
  for (const scene::Command* command : found) key_row(ui, plain, *command);
  if (found.empty()) note(ui, "No command matches.");
}

// Removes all changes at once; can be undone while the list is open.
void reset_all_button(const Context& ui) {
  scene::KeyList& list = ui.workspace.key_list;
  scene::Keymap& keymap = ui.workspace.preferences.keymap;
  if (!keymap.changes().empty()) list.taken_back.reset();
  const bool brings = list.taken_back.has_value();
  ImGui::BeginDisabled(!brings && keymap.changes().empty());
  if (ImGui::Button(brings ? "Restore changes" : "Reset all")) {
    if (brings) {
      keymap.put(*std::exchange(list.taken_back, std::nullopt));
    } else {
      list.taken_back = keymap.changes();
      keymap.take_all_back();
    }
  }
  record(ui, "reset_keys", brings || !keymap.changes().empty());
  ImGui::EndDisabled();
  hint(brings ? "Restore the changes that were just reset." : "Reset all keys to the keymap.");
}

void close_keys(scene::Workspace& w) {
  w.key_list = {};
  w.interaction.setting_key.clear();
}

}  // namespace

void key_list(const Context& ui) {
  scene::Workspace& w = ui.workspace;
  if (!w.key_list.open) return;
  const scene::Viewport& v = w.viewport;
  bool open = true;
  const Window window("Change keys",
                      {.at = {0.5f * v.window.x, v.origin.y + 0.5f * v.size.y},
                       .size = {std::min(list_width, v.window.x - 32), std::min(620.0f, v.size.y - 110)}},
                      dialog_flags, &open);
  command_choice(ui, {"keys_viete", "keys_blender", "keys_maya", "keys_viewer"},
                 static_cast<std::size_t>(w.preferences.keymap.preset()));
  search_field(ui, "keys_text", w.key_list.typed, w.key_list.appearing);
  ImGui::BeginChild("rows", {0, -(ImGui::GetFrameHeight() + 8)});
  key_rows(ui);
  ImGui::EndChild();
  reset_all_button(ui);
  ImGui::SameLine();
  if (ImGui::Button("Close")) open = false;
  record(ui, "close_keys");
  const bool waits = !w.interaction.setting_key.empty();
  // An Esc that cancels entering a key does not close the list.
  if (key_pressed(scene::Key::escape) && !waits && !w.key_list.waiting) open = false;
  w.key_list.waiting = waits;
  if (!open) close_keys(w);
}

float key_question(const Context& ui, float bottom) {
  scene::Workspace& w = ui.workspace;
  if (!w.view.hints) w.ask_keys = false;  // the user is already working
  if (!w.ask_keys || !w.view.panels || w.view.help || w.loading.running || w.browser.open || w.question ||
      offers_next_step(w))
    return bottom;
  const Window window("Choose keymap",
                      {.at = middle_at(ui, bottom - 56), .pivot = {0.5f, 1}, .padding = {16, 12}},
                      card_flags);
  ImGui::TextUnformatted("Choose a keymap");
  const auto presets = scene::choices(scene::KeyPreset{});
  for (std::size_t i = 0; i < presets.size(); ++i) {
    if (i > 0) ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    if (ImGui::Button(presets[i].label.data(), {72, 0})) {
      w.preferences.keymap.set_preset(static_cast<scene::KeyPreset>(i));
      w.ask_keys = false;
    }
    record(ui, "ask_keys/" + std::string(presets[i].word));
    hint(std::string(presets[i].hint) + " Change it later in Help, Keymap.");
  }
  ImGui::SameLine();
  if (ImGui::Button("x")) w.ask_keys = false;
  record(ui, "ask_keys/close");
  hint("Use the keymap Viete.");
  return ImGui::GetWindowPos().y + 28;
}

}  // namespace viete::ui
