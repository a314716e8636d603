// The command palette: a search field and a list of the matching commands.
#include <algorithm>

#include "ui/imgui_bridge.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/menus.h"

namespace viete::ui {

namespace {

constexpr float palette_width = 520, palette_row = 24, palette_rows = 12;

// Draws the row of a command. Returns true if the row was clicked.
bool row(const Context& ui, const workspace::Command& command, std::size_t index, bool follow) {
  const bool highlighted = index == ui.workspace.panels.palette.highlighted;
  const bool enabled = command.enabled(ui.workspace);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const bool clicked = ImGui::InvisibleButton(std::string(command.name).c_str(), {width, palette_row});
  record(ui, "palette/" + std::string(command.name), enabled);
  const bool mouse_moves = ImGui::GetIO().MouseDelta.x != 0 || ImGui::GetIO().MouseDelta.y != 0;
  if (ImGui::IsItemHovered() && mouse_moves) ui.workspace.panels.palette.highlighted = index;
  if (highlighted && follow) ImGui::SetScrollHereY();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (highlighted) draw.AddRectFilled(at, {at.x + width, at.y + palette_row}, ui.colors.card_active, 4);
  const float y = at.y + 0.5f * (palette_row - ImGui::GetFontSize());
  const std::string label = command.label_now(ui.workspace), group(command.group);
  draw.AddText({at.x + 8, y}, enabled ? ui.colors.text : faded(ui.colors.faint, 0.7f), label.c_str());
  const float after = std::max(160.0f, ImGui::CalcTextSize(label.c_str()).x + 16);
  draw.AddText({at.x + 8 + after, y}, faded(ui.colors.faint, enabled ? 0.9f : 0.5f), group.c_str());
  text_right(ui, at.x + width - 8, workspace::text(ui.workspace.preferences.keymap.of(command).first),
             ui.colors.faint, y);
  return clicked;
}

// Shows the command's hint, or why the command is disabled. The text is always two lines high.
void explanation(const Context& ui, const workspace::Command* command) {
  if (!command) return note_within(ui, 2, " ");
  const bool enabled = command->enabled(ui.workspace);
  note_within(ui, 2, std::string(enabled ? command->hint : command->enabled.otherwise),
              enabled ? ui.colors.faint : ui.colors.warn);
  record(ui, "palette_hint");
}

// Closes the palette first, because the command may open a window with keyboard input.
void run(workspace::Workspace& w, const workspace::Command& command) {
  if (!command.enabled(w)) return;
  w.panels.palette.open = false;
  command.run(w);
}

}  // namespace

void command_palette(const Context& ui) {
  workspace::Workspace& w = ui.workspace;
  workspace::Palette& palette = w.panels.palette;
  const document::Viewport& v = w.view.viewport;
  const Dialog dialog("Palette",
                      {.at = middle_at(ui, v.origin.y + 48),
                       .pivot = {0.5f, 0},
                       .size = {std::min(palette_width, v.window.x - 32), 0},
                       .border = 1},
                      fixed_flags);
  if (!dialog) return;
  const bool appeared = palette.appearing;
  const std::string before = palette.typed;
  search_field(ui, "palette_text", palette.typed, palette.appearing);
  if (palette.typed != before) palette.highlighted = 0;
  const auto found = workspace::find_commands(w, palette.typed);
  const int steps = arrow_steps();
  const auto n = static_cast<int>(std::max<std::size_t>(1, found.size()));
  palette.highlighted = static_cast<std::size_t>((static_cast<int>(palette.highlighted) + steps + n) % n);
  const float rows = std::min(palette_rows, std::floor((v.window.y - v.origin.y - 180) / palette_row));
  const workspace::Command* chosen = nullptr;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8, 0});
  ImGui::BeginChild("found", {0, std::max(3.0f, rows) * palette_row});
  for (std::size_t i = 0; i < found.size(); ++i)
    if (row(ui, *found[i], i, steps != 0)) {
      chosen = found[i];
      palette.highlighted = i;
    }
  if (found.empty()) note(ui, "No command matches.");
  ImGui::EndChild();
  ImGui::PopStyleVar();
  explanation(ui, found.empty() ? nullptr : found[palette.highlighted]);
  const bool beside = ImGui::IsMouseClicked(0) && !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows);
  if (!found.empty() && enter_pressed()) chosen = found[palette.highlighted];
  if ((key_pressed(workspace::Key::escape) || beside) && !appeared) palette.open = false;
  if (chosen) run(w, *chosen);
}

}  // namespace viete::ui
