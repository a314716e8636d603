#include "ui/panels.h"

#include <algorithm>

#include "ui/overlay_painter.h"
#include "ui/widgets.h"
#include "workspace/preferences.h"

namespace viete::ui {

namespace {

Window::Place column(const Context& ui, float x, float width) {
  const document::Viewport& v = ui.workspace.view.camera.viewport;
  return {
      .at = {x, v.origin.y}, .pivot = {0, 0}, .size = {width, workspace::column_height(v)}, .rounding = 0};
}

constexpr auto column_flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                              ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                              ImGuiWindowFlags_NoNavFocus | ImGuiWindowFlags_NoNavInputs;

void tools(const Context& ui) {
  const float width = ui.workspace.view.camera.viewport.origin.x;
  if (width <= 0) return;
  const Window window("Tools", column(ui, 0, width), column_flags);
  panel_model(ui);
  panel_cage(ui);
  panel_poses(ui);
  panel_transform(ui);
  panel_select(ui);
  panel_probes(ui);
  panel_display(ui);
  panel_checks(ui);  // last, because new findings open this section
}

void analysis(const Context& ui) {
  if (!section(ui, "Analysis", false)) return;
  panel_map(ui);
  panel_views(ui);
  panel_vertex(ui);
  panel_custom(ui);
  if (ui.workspace.jobs.reporting.running)
    progress_bar(ui, ImGui::GetContentRegionAvail().x, ui.workspace.jobs.reporting.done);
  command_row(ui, {ui.workspace.jobs.reporting.running ? "stop_report" : "show_report"});
}

void methods(const Context& ui) {
  const document::Viewport& v = ui.workspace.view.camera.viewport;
  const float x = v.origin.x + v.size.x;
  if (v.window.x <= x) return;
  const Window window("Methods", column(ui, x, v.window.x - x), column_flags);
  panel_method(ui);
  panel_timings(ui);
  panel_deformer(ui);
  ImGui::Dummy({0, 2});
  analysis(ui);
}

// At most one dialog is drawn. A question hides the others until it is answered.
void dialog(const Context& ui) {
  const workspace::Workspace& w = ui.workspace;
  if (w.files.question) {
    question_panel(ui);
  } else if (w.files.browser.open) {
    file_panel(ui);
  } else if (w.panels.palette.open) {
    command_palette(ui);
  } else if (w.panels.key_list.open) {
    key_list(ui);
  } else if (w.panels.show_messages) {
    message_log(ui);
  } else if (w.panels.show_preferences) {
    preferences_dialog(ui);
  }
  close_unused_dialog();
}

}  // namespace

void draw_panels(const Context& ui) {
  if (ui.workspace.view.tools) {
    torn_overlay(ui);
    probe_overlay(ui);
    hand_overlay(ui);
    gizmo_overlay(ui);
  }
  vertex_overlay(ui);
  axis_overlay(ui);
  split_overlay(ui);
  if (ui.workspace.view.tools) view_overlay(ui);
  if (ui.workspace.view.options.panels) {
    menu_bar(ui);
    tool_strip(ui);
    tools(ui);
    methods(ui);
    timeline_panel(ui);
    column_edges(ui);
    status_bar(ui);
  }
  context_menu(ui);
  const document::Viewport& v = ui.workspace.view.camera.viewport;
  notice_bar(ui);
  const float bottom = work_bar(ui, map_legend(ui, v.origin.y + v.size.y));
  toasts(ui, std::min(cage_offer(ui, bottom), key_question(ui, bottom)) - 44);
  dialog(ui);
}

namespace {

using workspace::Column;

constexpr float edge_thickness = 6, tab_width = 14, tab_height = 48;

struct Side {
  Column column;
  const char* name;     // widget name: "edge/methods"
  const char* command;  // shows or hides the column
  float inward;         // 1: the view is to the right of the column; -1: to the left
};
constexpr Side sides[] = {{Column::tools, "tools", "toggle_tools", 1},
                          {Column::methods, "methods", "toggle_methods", -1}};

// The border between column and view. If the column is hidden, this is the window's edge.
float edge_x(const document::Viewport& v, const Side& side) {
  return side.inward > 0 ? v.origin.x : v.origin.x + v.size.x;
}

// The place of a small window over the view, at the column's border.
Window::Place edge_strip(const Side& side, ImVec2 at, ImVec2 size) {
  return {
      .at = at, .pivot = {side.inward > 0 ? 0.0f : 1.0f, 0}, .size = size, .rounding = 0, .padding = {0, 0}};
}

constexpr auto strip_flags = passive_flags | ImGuiWindowFlags_NoBackground;

void edge(const Context& ui, const Side& side) {
  workspace::Workspace& w = ui.workspace;
  const document::Viewport& v = w.view.camera.viewport;
  const float x = edge_x(v, side);
  const std::string name = std::string("edge/") + side.name;
  const ImVec2 size{edge_thickness, workspace::column_height(v)};
  const Window window(name.c_str(), edge_strip(side, {x, v.origin.y}, size), strip_flags);
  ImGui::InvisibleButton("strip", size);
  record(ui, name);
  const bool held = ImGui::IsItemActive();
  if (held || ImGui::IsItemHovered()) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    ImGui::GetWindowDrawList()->AddRectFilled({x, v.origin.y},
                                              {x + side.inward * 2, v.origin.y + workspace::column_height(v)},
                                              faded(ui.colors.accent, held ? 0.9f : 0.5f));
  }
  if (held) {
    const float mouse = ImGui::GetIO().MousePos.x;
    workspace::set_width(w.preferences.layout, side.column, side.inward > 0 ? mouse : v.window.x - mouse,
                         v.window.x);
  }
}

void chevron(ImDrawList& draw, ImVec2 middle, float direction, ImU32 color) {
  const float x = 2.5f * direction;
  draw.PathLineTo({middle.x - x, middle.y - 5});
  draw.PathLineTo({middle.x + x, middle.y});
  draw.PathLineTo({middle.x - x, middle.y + 5});
  draw.PathStroke(color, 0, 1.5f);
}

void tab(const Context& ui, const Side& side, bool shown) {
  const document::Viewport& v = ui.workspace.view.camera.viewport;
  const workspace::Command& command = *workspace::find_command(side.command);
  const ImVec2 at{edge_x(v, side), v.origin.y + 0.5f * (v.size.y - tab_height)};
  const std::string name = std::string("tab/") + side.name;
  const ImVec2 size{tab_width, tab_height};
  const Window window(name.c_str(), edge_strip(side, at, size), strip_flags);
  const bool clicked = ImGui::InvisibleButton("strip", size);
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
}

}  // namespace

void column_edges(const Context& ui) {
  const workspace::Workspace& w = ui.workspace;
  const auto widths = workspace::shown_columns(w.preferences.layout, w.view.camera.viewport.window.x);
  for (const Side& side : sides) {
    const bool shown = widths.of(side.column) > 0;
    if (shown) edge(ui, side);
    tab(ui, side, shown);
  }
}

}  // namespace viete::ui
