// The command palette: search by name; arrow keys and Enter, or a click.
#include <algorithm>

#include "scene/workspace/menus.h"
#include "ui/imgui_bridge.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

constexpr float palette_width = 520, palette_row = 24, palette_rows = 12;

// True if it was clicked.
bool row(const Context& ui, const scene::Command& command, std::size_t index, bool follow) {
  const bool highlighted = index == ui.workspace.palette.highlighted;
  const bool enabled = command.enabled(ui.workspace);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const bool clicked = ImGui::InvisibleButton(std::string(command.name).c_str(), {width, palette_row});
  record(ui, "palette/" + std::string(command.name), enabled);
  const bool mouse_moves = ImGui::GetIO().MouseDelta.x != 0 || ImGui::GetIO().MouseDelta.y != 0;
  if (ImGui::IsItemHovered() && mouse_moves) ui.workspace.palette.highlighted = index;
  if (ImGui::IsItemClicked(1)) ui.workspace.interaction.setting_key = command.name;
  if (highlighted && follow) ImGui::SetScrollHereY();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (highlighted) draw.AddRectFilled(at, {at.x + width, at.y + palette_row}, ui.colors.card_active, 4);
  const float y = at.y + 0.5f * (palette_row - ImGui::GetFontSize());
  const std::string label = command.label_now(ui.workspace), group(command.group);
  draw.AddText({at.x + 8, y}, enabled ? ui.colors.text : faded(ui.colors.faint, 0.7f), label.c_str());
  const float after = std::max(160.0f, ImGui::CalcTextSize(label.c_str()).x + 16);
  draw.AddText({at.x + 8 + after, y}, faded(ui.colors.faint, enabled ? 0.9f : 0.5f), group.c_str());
  text_right(ui, at.x + width - 8, scene::text(ui.workspace.preferences.keymap.of(command).first),
             ui.colors.faint, y);
  return clicked;
}

// The hint of the highlighted command, or why it is disabled; always two lines high.
void explanation(const Context& ui, const scene::Command* command) {
  if (!command) return note_within(ui, 2, " ");
  const bool enabled = command->enabled(ui.workspace);
  note_within(ui, 2, std::string(enabled ? command->hint : command->enabled.otherwise),
              enabled ? ui.colors.faint : ui.colors.warn);
  record(ui, "palette_hint");
}

void step(scene::Palette& palette, std::size_t count, int steps) {
  if (count == 0) return;
  const auto n = static_cast<int>(count);
  palette.highlighted = static_cast<std::size_t>((static_cast<int>(palette.highlighted) + steps + n) % n);
}

// Closes first: a command may open a window that takes the keyboard.
void run(scene::Workspace& w, const scene::Command& command) {
  if (!command.enabled(w)) return;
  w.palette.open = false;
  command.run(w);
}

}  // namespace

void command_palette(const Context& ui) {
  scene::Workspace& w = ui.workspace;
  scene::Palette& palette = w.palette;
  if (!palette.open) return;
  const scene::Viewport& v = w.viewport;
  const Window window("Palette",
                      {.at = middle_at(ui, v.origin.y + 48),
                       .pivot = {0.5f, 0},
                       .size = {std::min(palette_width, v.window.x - 32), 0},
                       .border = 1},
                      fixed_flags);
  const bool appeared = palette.appearing;
  const std::string before = palette.typed;
  search_field(ui, "palette_text", palette.typed, palette.appearing);
  if (palette.typed != before) palette.highlighted = 0;
  const auto found = scene::find_commands(w, palette.typed);
  const int steps =
      (key_pressed(scene::Key::down, true) ? 1 : 0) - (key_pressed(scene::Key::up, true) ? 1 : 0);
  if (steps != 0) step(palette, found.size(), steps);
  palette.highlighted = std::min(palette.highlighted, found.empty() ? 0 : found.size() - 1);
  const float rows = std::min(palette_rows, std::floor((v.size.y - 180) / palette_row));
  const scene::Command* chosen = nullptr;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8, 0});
  ImGui::BeginChild("found", {0, std::max(3.0f, rows) * palette_row});
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (row(ui, *found[i], i, steps != 0)) chosen = found[i], palette.highlighted = i;
  }
  if (found.empty()) note(ui, "No command matches.");
  ImGui::EndChild();
  ImGui::PopStyleVar();
  note(ui, "Right click a command to change its key;  Help, Change keys lists all");
  explanation(ui, found.empty() ? nullptr : found[palette.highlighted]);
  const bool beside = ImGui::IsMouseClicked(0) && !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows);
  if (!found.empty() && (key_pressed(scene::Key::enter) || key_pressed(scene::Key::pad_enter)))
    chosen = found[palette.highlighted];
  if ((key_pressed(scene::Key::escape) || beside) && !appeared) palette.open = false;
  if (!w.interaction.setting_key.empty()) palette.open = false;
  if (chosen) run(w, *chosen);
}

// Asks for the new key of a command.
void key_prompt(const Context& ui) {
  const scene::Workspace& w = ui.workspace;
  const scene::Command* const command = scene::find_command(w.interaction.setting_key);
  if (!command || w.key_list.open) return;  // the list shows it itself
  const scene::Viewport& v = w.viewport;
  const Window window("New key", {.at = middle_at(ui, v.origin.y + 0.4f * v.size.y)}, sized_flags);
  const std::string now = scene::text(w.preferences.keymap.of(*command).first);
  ImGui::TextUnformatted(("Press the new key for \"" + std::string(command->label) + '"').c_str());
  note(ui, (now.empty() ? "No key now" : "Now " + now) + std::string(";  Delete removes it, Esc cancels"));
}

}  // namespace viete::ui
