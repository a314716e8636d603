// The tool strip at the left of the view: icons and keys of the tools.
#include <algorithm>
#include <cmath>
#include <span>

#include "ui/imgui_bridge.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/command.h"

namespace viete::ui {

namespace {

constexpr float tool_size = 36, tool_gap = 4, strip_inset = 20, strip_top = 12, icon_radius = 8;
constexpr float pi = 3.14159265f;

void spot(const Pen& pen, float x, float y) {
  pen.draw.AddCircleFilled(pen.at(x, y), 2.2f, pen.color);
}

// An arrow head with its tip at (x, y), pointing along (dx, dy).
void head(const Pen& pen, float x, float y, float dx, float dy) {
  pen.draw.AddTriangleFilled(pen.at(x, y), pen.at(x - 0.45f * dx - 0.35f * dy, y - 0.45f * dy + 0.35f * dx),
                             pen.at(x - 0.45f * dx + 0.35f * dy, y - 0.45f * dy - 0.35f * dx), pen.color);
}

template <std::size_t n>
void outline(const Pen& pen, const float (&corners)[n][2]) {
  for (std::size_t i = 0; i < n; ++i)
    pen.line(corners[i][0], corners[i][1], corners[(i + 1) % n][0], corners[(i + 1) % n][1]);
}

void select_icon(const Pen& pen) {
  outline(pen,
          {{-0.55f, -0.95f}, {-0.55f, 0.6f}, {-0.15f, 0.25f}, {0.2f, 0.95f}, {0.4f, 0.05f}, {0.7f, 0.05f}});
}

void move_icon(const Pen& pen) {
  pen.line(-0.8f, 0, 0.8f, 0);
  pen.line(0, -0.8f, 0, 0.8f);
  head(pen, 1, 0, 1, 0);
  head(pen, -1, 0, -1, 0);
  head(pen, 0, 1, 0, 1);
  head(pen, 0, -1, 0, -1);
}

void rotate_icon(const Pen& pen) {
  pen.draw.PathArcTo(pen.middle, 0.8f * icon_radius, -0.35f * pi, 1.3f * pi, 24);
  pen.draw.PathStroke(pen.color, 0, 1.5f);
  head(pen, 0.05f, -0.95f, -0.9f, -0.45f);
}

void scale_icon(const Pen& pen) {
  pen.draw.AddRect(pen.at(-0.9f, 0.1f), pen.at(-0.1f, 0.9f), pen.color, 0, 0, 1.5f);
  pen.line(0.05f, -0.05f, 0.75f, -0.75f);
  head(pen, 0.95f, -0.95f, 0.7f, -0.7f);
}

void paint_icon(const Pen& pen) {
  pen.line(0.9f, -0.9f, 0, 0);
  pen.line(0.7f, -0.95f, -0.15f, -0.1f);
  pen.draw.AddCircleFilled(pen.at(-0.45f, 0.45f), 0.42f * icon_radius, pen.color);
  pen.draw.AddTriangleFilled(pen.at(-0.8f, 0.25f), pen.at(-0.95f, 0.95f), pen.at(-0.25f, 0.8f), pen.color);
}

void box_icon(const Pen& pen) {
  for (const float side : {-0.8f, 0.8f}) {
    for (const float from : {-0.8f, -0.2f, 0.4f}) {  // dashes
      pen.line(from, side, from + 0.4f, side);
      pen.line(side, from, side, from + 0.4f);
    }
  }
}

void lasso_icon(const Pen& pen) {
  constexpr int corners = 24;
  for (int i = 0; i < corners; ++i) {
    const float angle = 2 * pi * static_cast<float>(i) / corners;
    pen.draw.PathLineTo(pen.at(0.95f * std::cos(angle), -0.3f + 0.6f * std::sin(angle)));
  }
  pen.draw.PathStroke(pen.color, ImDrawFlags_Closed, 1.5f);
  pen.line(-0.35f, 0.25f, -0.55f, 0.95f);
}

void brush_icon(const Pen& pen) {
  pen.draw.AddCircle(pen.middle, 0.85f * icon_radius, pen.color, 0, 1.5f);
  spot(pen, 0, 0);
}

void cage_icon(const Pen& pen) {
  constexpr float corners[][2] = {{-0.85f, 0.7f}, {0.5f, 0.9f}, {0.85f, -0.4f}, {-0.3f, -0.9f}};
  outline(pen, corners);
  for (const auto& [x, y] : corners) spot(pen, x, y);
}

void probe_icon(const Pen& pen) {
  pen.line(-0.2f, 0.2f, -0.2f, -0.9f);
  pen.line(-0.2f, 0.2f, 0.9f, 0.2f);
  pen.line(-0.2f, 0.2f, -0.85f, 0.85f);
  spot(pen, -0.2f, 0.2f);
}

void more_icon(const Pen& pen) {
  for (const float x : {-0.75f, 0.0f, 0.75f}) spot(pen, x, 0.2f);
}

struct StripTool {
  const char* command;
  void (*icon)(const Pen&);
  bool apart;  // there is a gap before this tool
};
constexpr StripTool strip[] = {{"tool_select", select_icon, false}, {"tool_move", move_icon, false},
                               {"tool_rotate", rotate_icon, false}, {"tool_scale", scale_icon, false},
                               {"tool_paint", paint_icon, false},   {"select_box", box_icon, true},
                               {"select_lasso", lasso_icon, false}, {"select_brush", brush_icon, false},
                               {"edit_cage", cage_icon, true},      {"add_probe", probe_icon, false}};

float top_of(std::size_t index) {
  float y = static_cast<float>(index) * (tool_size + tool_gap);
  for (std::size_t i = 0; i <= index; ++i) y += strip[i].apart ? 2 * tool_gap : 0;
  return y;
}

// The number of tools that fit. If a tool does not fit, a button for the remaining tools must fit.
std::size_t fitting_tools(float height) {
  const auto fits = [&](std::size_t slots) {
    return top_of(slots - 1) + tool_size + 2 * strip_top <= height;
  };
  std::size_t count = std::size(strip);
  if (fits(count)) return count;
  while (--count > 0 && !fits(count + 1)) continue;
  return count;
}

bool is_on(const Context& ui, const StripTool& entry) {
  return workspace::find_command(entry.command)->on(ui.workspace);
}

// Draws a button with the icon of a tool. Returns true if the button was clicked.
bool tool_card(const Context& ui, const char* name, void (*icon)(const Pen&), ImVec2 at, bool enabled,
               bool on) {
  ImGui::SetCursorScreenPos(at);
  ImGui::BeginDisabled(!enabled);
  const bool clicked = ImGui::InvisibleButton(name, {tool_size, tool_size});
  record(ui, std::string("strip/") + name, enabled);
  ImGui::EndDisabled();
  const bool hovered = enabled && ImGui::IsItemHovered();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 end{at.x + tool_size, at.y + tool_size};
  const ImU32 back = on ? ui.colors.card_active : hovered ? ui.colors.card_hover : ui.colors.card;
  draw.AddRectFilled(at, end, faded(back, enabled ? 0.94f : 0.5f), 6);
  if (on) draw.AddRect(at, end, faded(ui.colors.accent, 0.8f), 6);
  const ImU32 color = on ? ui.colors.accent : hovered ? ui.colors.text : ui.colors.faint;
  icon({draw, {at.x + 15, at.y + 16}, faded(color, enabled ? 1 : 0.45f), icon_radius});
  return clicked;
}

void tool(const Context& ui, const StripTool& entry, ImVec2 at) {
  const workspace::Command& command = *workspace::find_command(entry.command);
  const bool enabled = command.enabled(ui.workspace);
  if (tool_card(ui, entry.command, entry.icon, at, enabled, is_on(ui, entry))) command.run(ui.workspace);
  const std::string key = workspace::text(ui.workspace.preferences.keymap.of(command).first);
  const float size = key.size() > 1 ? 9.0f : 11.0f;
  const ImVec2 room = ImGui::GetFont()->CalcTextSizeA(size, 100, 0, key.c_str());
  ImGui::GetWindowDrawList()->AddText(ImGui::GetFont(), size,
                                      {at.x + tool_size - room.x - 4, at.y + tool_size - room.y - 2},
                                      faded(ui.colors.faint, enabled ? 1 : 0.45f), key.c_str());
  hint(std::string(command.label) + ".  " + hint_of(ui, command));
}

// A menu of the tools that do not fit.
void more_tools(const Context& ui, std::span<const StripTool> others, ImVec2 at) {
  const bool on = std::ranges::any_of(others, [&](const StripTool& t) { return is_on(ui, t); });
  if (tool_card(ui, "more", more_icon, at, true, on)) ImGui::OpenPopup("More tools");
  hint("More tools.");
  if (!ImGui::BeginPopup("More tools")) return;
  if (key_pressed(workspace::Key::escape)) ImGui::CloseCurrentPopup();
  for (const StripTool& entry : others) menu_item(ui, *workspace::find_command(entry.command));
  ImGui::EndPopup();
}

}  // namespace

void tool_strip(const Context& ui) {
  const document::Viewport& v = ui.workspace.view.camera.viewport;
  if (!ui.workspace.document.model().surface) return;
  const std::size_t count = fitting_tools(v.size.y);
  const bool all = count == std::size(strip);
  const float height = top_of(count - (all ? 1 : 0)) + tool_size;
  const ImVec2 low{v.origin.x + strip_inset, v.origin.y + strip_top};
  const Window window(
      "Strip", {.at = low, .pivot = {0, 0}, .size = {tool_size, height}, .rounding = 0, .padding = {0, 0}},
      passive_flags | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoBringToFrontOnFocus);
  for (std::size_t i = 0; i < count; ++i) tool(ui, strip[i], {low.x, low.y + top_of(i)});
  if (!all) more_tools(ui, std::span(strip).subspan(count), {low.x, low.y + top_of(count)});
}

}  // namespace viete::ui
