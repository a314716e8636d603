#include "scene/hand/picking.h"
#include "scene/hand/cursor_projection.h"
#include "scene/workspace/command.h"
#include "ui/mouse_words.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

// About as large as it reaches at the model.
void brush_ring(const Context& ui, const scene::Workspace& w) {
  const scene::Projector project(w.document.space, w.camera, w.viewport);
  const auto center = project(*w.interaction.brush);
  if (!center) return;
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const ImVec2 at{center->x, center->y};
  draw.AddCircle(at, w.brush.radius, faded(ui.colors.halo, 1.0f), 0, 3);
  draw.AddCircle(at, w.brush.radius, faded(ui.colors.text, 0.9f), 0, 1.25f);
  draw.AddCircleFilled(at, 2, faded(ui.colors.text, 0.9f));
}

// False if there is no room for it.
bool centered(const Context& ui, float y, const std::string& line, ImU32 color) {
  const char* const text = line.c_str();
  const auto& v = ui.workspace.viewport;
  ImGui::PushFont(ui.fonts.text);
  const ImVec2 size = ImGui::CalcTextSize(text);
  const bool fits = size.x + 24 <= v.size.x;
  if (fits)
    ImGui::GetBackgroundDrawList()->AddText({v.origin.x + 0.5f * (v.size.x - size.x), y}, color, text);
  ImGui::PopFont();
  return fits;
}

void editing_hint(const Context& ui) {
  const auto& v = ui.workspace.viewport;
  const std::string key = key_or_label(ui.workspace.remembered.keymap, "edit_cage");
  centered(ui, v.origin.y + v.size.y - 34, "Editing the cage at rest     " + key + " goes back to posing it",
           ui.colors.accent);
}

void hints(const Context& ui) {
  const auto& w = ui.workspace;
  const float y = w.viewport.origin.y + w.viewport.size.y - 34;
  const ImU32 color = faded(ui.colors.text, 0.75f);
  const std::string space = scene::text(w.remembered.keymap.of(*scene::find_command("play")).first);
  const std::string help = key_or_label(w.remembered.keymap, "help");
  const std::string plays =
      w.document.timeline.keys.empty() || space.empty() ? "" : "     " + space + " plays it";
  for (const char* method : {"     Switch the method in the right column", ""}) {
    const std::string text =
        "Drag a vertex of the cage" + plays + method + "     " + help + " shows every key";
    if (centered(ui, y, text, color)) return;
  }
}

// Nobody is left alone with a view without a word.
void way_back(const Context& ui) {
  const scene::Command& command = *scene::find_command("toggle_panels");
  const std::string text =
      scene::text(ui.workspace.remembered.keymap.of(command).first) + " shows the panels again";
  const auto& v = ui.workspace.viewport;
  ImGui::PushFont(ui.fonts.text);
  ImGui::GetBackgroundDrawList()->AddText({v.origin.x + 16, v.origin.y + v.size.y - 28},
                                          faded(ui.colors.text, 0.5f), text.c_str());
  ImGui::PopFont();
}

}  // namespace

void view_overlay(const Context& ui) {
  const auto& w = ui.workspace;
  select_overlay(ui);
  if (!w.view.panels && w.attended) way_back(ui);
  if (w.interaction.brush) brush_ring(ui, w);
  if (w.binding.running || w.loading.running || w.making_cage.running) return;  // their bar is there
  if (w.document.kept_pose && w.view.panels) return editing_hint(ui);
  const bool room =  // the legend takes it, or paint, or what is to be done first
      scene::shown_field(w) == lab::Field::none && !scene::shows_mask(w) && !offers_next_step(w);
  if (w.view.hints && room && w.document.has_cage() && w.view.panels && !w.interaction.drag) hints(ui);
}

}  // namespace viete::ui
