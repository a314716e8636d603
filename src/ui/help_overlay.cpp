#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "scene/workspace/command.h"
#include "ui/mouse_words.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

// A line of the table; a heading where there is nothing on its right.
struct Row {
  std::string left, right;
};
using Rows = std::vector<Row>;

// Every key, under the headings of its groups, which the table of commands has one after the other: those of
// files, edits and selections, or the others.
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
  const scene::Keymap& keymap = ui.workspace.remembered.keymap;
  const std::string label(scene::entry_of(keymap.preset()).label);
  return label + (keymap.changes().empty() ? "" : ", changed");
}

}  // namespace

// Two tables side by side where there is room, else one below the other.
void help_overlay(const Context& ui) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  constexpr float gap = 32;
  const Rows hands = hands_rows(ui.workspace.remembered.keymap),
             settings = settings_rows(ui.workspace.remembered.keymap, ui.workspace.about);
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
  note(ui, "Keys of " + preset_label(ui) + ".  Help, Change keys gives any command another one.");
  table(ui, "hands", hands);
  if (both < display.x - 40) ImGui::SameLine(0, gap);
  table(ui, "settings", settings);
  if (!open) ui.workspace.view.help = false;
}

}  // namespace viete::ui
