// What is said while a script moves the cursor: the chapter, a way on and back; and the cursor itself.
#include <algorithm>
#include <cstdio>
#include <string>

#include "scene/workspace/command.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

constexpr float text_width = 460;

// As a screen shows it: an arrow with an edge, its tip at the place.
void arrow(ImVec2 at, ImU32 fill, ImU32 edge) {
  ImDrawList& draw = *ImGui::GetForegroundDrawList();
  const ImVec2 tail[] = {{0, 0}, {0, 17}, {4, 13.2f}, {6.8f, 19}, {9.6f, 17.8f}, {6.8f, 12}, {12, 12}};
  ImVec2 corners[7];
  for (int i = 0; i < 7; ++i) corners[i] = {at.x + tail[i].x, at.y + tail[i].y};
  draw.AddTriangleFilled(corners[0], corners[1], corners[6], fill);
  draw.AddQuadFilled(corners[2], corners[3], corners[4], corners[5], fill);
  draw.AddPolyline(corners, 7, edge, ImDrawFlags_Closed, 1.5f);
}

}  // namespace

void script_cursor(const Context& ui) {
  const ImVec2 at = ImGui::GetIO().MousePos;
  if (!ui.workspace.scripting.playing || !ImGui::IsMousePosValid(&at)) return;
  arrow(at, ui.colors.accent, ui.colors.card);
}

float script_card(const Context& ui, float bottom) {
  const scene::Scripting& state = ui.workspace.scripting;
  if (!state.shown() || state.chapter == 0) return bottom;
  const float width = std::min(text_width, notice_room(ui) - 32);
  const Window window("Tour", {.at = middle_at(ui, bottom - 28), .pivot = {0.5f, 1}, .padding = {16, 14}},
                      card_flags);
  const std::string number = std::to_string(state.chapter) + " of " + std::to_string(state.of);
  const float right = ImGui::GetCursorScreenPos().x + width;
  text_right(ui, right, number, ui.colors.faint);
  ImGui::PushFont(ui.fonts.strong);
  ImGui::TextUnformatted(state.title.c_str());
  ImGui::PopFont();
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
  text_in(ui.colors.faint, state.text);
  ImGui::PopTextWrapPos();
  ImGui::Dummy({width, 2});
  const bool last = state.chapter == state.of;
  if (last) {
    command_row(ui, {"previous_chapter", "end_script"});
  } else {
    command_row(ui, {"previous_chapter", "end_script", "next_chapter"});
  }
  record(ui, "tour");
  return ImGui::GetWindowPos().y + 28;
}

// A red point in the menu bar, which ends it.
void recording_mark(const Context& ui) {
  const scene::Scripting& state = ui.workspace.scripting;
  if (!state.recording) return;
  char time[32];
  const int seconds = static_cast<int>(state.recorded);
  std::snprintf(time, sizeof time, "Recording %d:%02d", seconds / 60, seconds % 60);
  const float width = ImGui::CalcTextSize(time).x + 28;
  ImGui::SameLine(ui.workspace.viewport.window.x - width - 8);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = scene::PanelLayout::menu_height;
  if (ImGui::InvisibleButton("recording", {width, height})) scene::find_command("record")->run(ui.workspace);
  record(ui, "recording");
  hint("Ends the recording.");
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float middle = at.y + 0.5f * height;
  draw.AddCircleFilled({at.x + 10, middle}, 5, ui.colors.bad);
  draw.AddText({at.x + 22, middle - 0.5f * ImGui::GetFontSize()},
               ImGui::IsItemHovered() ? ui.colors.text : ui.colors.faint, time);
}

}  // namespace viete::ui
