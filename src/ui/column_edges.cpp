// The inner edges of the columns: dragged to make them wider or narrower, with a tab each that folds a column
// away and brings it back.
#include "scene/workspace/command.h"
#include "scene/workspace/remembered.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

using scene::Column;

constexpr float edge_thickness = 6, tab_width = 14, tab_height = 48;

struct Side {
  Column column;
  const char* name;     // of widgets: "edge/methods"
  const char* command;  // folds it away, and brings it back
  float inward;         // 1: the view is to the right of it
};
constexpr Side sides[] = {{Column::tools, "tools", "toggle_tools", 1},
                          {Column::methods, "methods", "toggle_methods", -1}};

// Where the column ends and the view begins; at the edge of the window while it is not shown.
float edge_x(const scene::Viewport& v, const Side& side) {
  return side.inward > 0 ? v.origin.x : v.origin.x + v.size.x;
}

// A window over the view that is nothing but one button, from the edge inwards.
bool begin_strip(const std::string& name, const Side& side, ImVec2 at, ImVec2 size) {
  constexpr auto flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBackground |
                         ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
  ImGui::SetNextWindowPos({side.inward > 0 ? at.x : at.x - size.x, at.y});
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin(name.c_str(), nullptr, flags);
  const bool clicked = ImGui::InvisibleButton("strip", size);
  ImGui::PopStyleVar(2);
  return clicked;
}

void edge(const Context& ui, const Side& side) {
  scene::Workspace& w = ui.workspace;
  const scene::Viewport& v = w.viewport;
  const float x = edge_x(v, side);
  begin_strip(std::string("edge/") + side.name, side, {x, v.origin.y},
              {edge_thickness, scene::column_height(v)});
  record(ui, std::string("edge/") + side.name);
  const bool held = ImGui::IsItemActive();
  if (held || ImGui::IsItemHovered()) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    ImGui::GetWindowDrawList()->AddRectFilled({x, v.origin.y},
                                              {x + side.inward * 2, v.origin.y + scene::column_height(v)},
                                              faded(ui.colors.accent, held ? 0.9f : 0.5f));
  }
  if (held) {
    const float mouse = ImGui::GetIO().MousePos.x;
    scene::set_width(w.remembered.layout, side.column, side.inward > 0 ? mouse : v.window.x - mouse,
                     v.window.x);
  }
  ImGui::End();
}

void chevron(ImDrawList& draw, ImVec2 middle, float direction, ImU32 color) {
  const float x = 2.5f * direction;
  draw.PathLineTo({middle.x - x, middle.y - 5});
  draw.PathLineTo({middle.x + x, middle.y});
  draw.PathLineTo({middle.x - x, middle.y + 5});
  draw.PathStroke(color, 0, 1.5f);
}

void tab(const Context& ui, const Side& side, bool shown) {
  const scene::Viewport& v = ui.workspace.viewport;
  const scene::Command& command = *scene::find_command(side.command);
  const ImVec2 at{edge_x(v, side), v.origin.y + 0.5f * (v.size.y - tab_height)};
  const std::string name = std::string("tab/") + side.name;
  const bool clicked = begin_strip(name, side, at, {tab_width, tab_height});
  record(ui, name);
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float left = side.inward > 0 ? at.x : at.x - tab_width;
  if (hovered || !shown)
    draw.AddRectFilled({left, at.y}, {left + tab_width, at.y + tab_height},
                       hovered ? ui.colors.card_hover : ui.colors.card, 4,
                       side.inward > 0 ? ImDrawFlags_RoundCornersRight : ImDrawFlags_RoundCornersLeft);
  chevron(draw, {left + 0.5f * tab_width, at.y + 0.5f * tab_height}, shown ? -side.inward : side.inward,
          hovered ? ui.colors.text : faded(ui.colors.faint, shown ? 0.7f : 1));
  hint(std::string(command.hint));
  if (clicked) command.run(ui.workspace);
  ImGui::End();
}

}  // namespace

void column_edges(const Context& ui) {
  const scene::Workspace& w = ui.workspace;
  const auto widths = scene::shown_columns(w.remembered.layout, w.viewport.window.x);
  for (const Side& side : sides) {
    const bool shown = widths.of(side.column) > 0;
    if (shown) edge(ui, side);
    tab(ui, side, shown);
  }
}

}  // namespace viete::ui
