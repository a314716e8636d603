#include "ui/panels.h"
#include "ui/widgets.h"

#include <algorithm>

namespace viete::ui {

namespace {

// Beside the view, over its whole height. False if there is none.
bool begin_column(const Context& ui, const char* name, float x, float width) {
  if (width <= 0) return false;
  const scene::Viewport& v = ui.workspace.viewport;
  ImGui::SetNextWindowPos({x, v.origin.y});
  ImGui::SetNextWindowSize({width, scene::column_height(v)});
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNavFocus |
                   ImGuiWindowFlags_NoNavInputs);
  return true;
}

// The left column, in the order of the work.
void tools(const Context& ui) {
  if (!begin_column(ui, "Tools", 0, ui.workspace.viewport.origin.x)) return;
  panel_model(ui);
  panel_cage(ui);
  panel_poses(ui);
  panel_transform(ui);
  panel_select(ui);
  panel_probes(ui);
  panel_display(ui);
  panel_checks(ui);  // last: what is found opens it, and pushes nothing
  ImGui::End();
}

void analysis(const Context& ui) {
  if (!section(ui, "Analysis", false)) return;
  panel_map(ui);
  panel_views(ui);
  panel_vertex(ui);
  panel_custom(ui);
  panel_measures(ui);
  if (ui.workspace.reporting.running)
    progress_bar(ui, ImGui::GetContentRegionAvail().x, ui.workspace.reporting.done);
  command_row(ui, {ui.workspace.reporting.running ? "stop_report" : "show_report"});
}

// The right column: how the deformation is computed, how fast and how exactly.
void methods(const Context& ui) {
  const scene::Viewport& v = ui.workspace.viewport;
  const float x = v.origin.x + v.size.x;
  if (!begin_column(ui, "Methods", x, v.window.x - x)) return;
  panel_method(ui);
  panel_timings(ui);
  panel_deformer(ui);
  ImGui::Dummy({0, 2});
  analysis(ui);
  ImGui::End();
}

}  // namespace

void draw_panels(const Context& ui) {
  const ImDrawList& background = *ImGui::GetBackgroundDrawList();
  const DrawnBefore before{background.VtxBuffer.Size, background.IdxBuffer.Size,
                           static_cast<int>(background._VtxCurrentIdx)};
  path_overlay(ui);
  if (ui.workspace.tools) torn_overlay(ui), probe_overlay(ui), hand_overlay(ui), gizmo_overlay(ui);
  vertex_overlay(ui);
  repeat_in_views(ui, before);
  axis_overlay(ui);
  split_overlay(ui);
  if (ui.workspace.tools) view_overlay(ui);
  mark_overlay(ui);
  if (ui.workspace.view.panels) {
    menu_bar(ui);
    tool_strip(ui);
    tools(ui);
    methods(ui);
    timeline_panel(ui);
    column_edges(ui);
    status_bar(ui);
  }
  context_menu(ui);
  const scene::Viewport& v = ui.workspace.viewport;
  const float bottom = v.origin.y + v.size.y;
  notice_bar(ui);
  const float free = std::min({cage_offer(ui, bottom), work_bar(ui, bottom), map_legend(ui, bottom),
                               key_question(ui, bottom)}) -
                     44;
  toasts(ui, check_badge(ui, free));
  if (ui.workspace.view.help) help_overlay(ui);
  if (ui.workspace.browser.open && !ui.workspace.question) file_panel(ui);
  message_log(ui);
  command_palette(ui);
  key_list(ui);
  key_prompt(ui);
  question_panel(ui);
}

}  // namespace viete::ui
