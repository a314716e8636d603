#include "ui/panels.h"

namespace viete::ui {

namespace {

void column(const Context& ui) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize({column_width, display.y - status_height});
  ImGui::Begin("Panels", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNavFocus |
                   ImGuiWindowFlags_NoNavInputs);
  panel_messages(ui);
  panel_model(ui);
  panel_cage(ui);
  panel_probes(ui);
  panel_checks(ui);
  panel_measures(ui);
  panel_method(ui);
  panel_timings(ui);
  panel_accuracy(ui);
  panel_view(ui);
  panel_benchmark(ui);
  ImGui::End();
}

}  // namespace

void draw_panels(const Context& ui) {
  probe_overlay(ui);
  gizmo_overlay(ui);
  axis_overlay(ui);
  view_overlay(ui);
  mark_overlay(ui);
  error_legend(ui);
  if (ui.workspace.view.panels) {
    column(ui);
    status_bar(ui);
  }
  cage_offer(ui);
  notice_bar(ui);
  work_bar(ui);
  if (ui.workspace.view.help) help_overlay(ui);
  if (ui.workspace.browser.open && !ui.workspace.question) file_panel(ui);
  question_panel(ui);
}

}  // namespace viete::ui
