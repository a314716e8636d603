#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

void panel_view(const Context& ui) {
  if (!section(ui, "View")) return;
  const auto& view = ui.workspace.view;
  const float half = 0.5f * ImGui::GetContentRegionAvail().x;
  const float left = ImGui::GetCursorPosX();
  command_toggle(ui, "toggle_model", view.model);
  ImGui::SameLine(left + half);
  command_toggle(ui, "toggle_wireframe", view.wireframe);
  command_toggle(ui, "toggle_cage", view.cage);
  ImGui::SameLine(left + half);
  command_toggle(ui, "toggle_ghost", view.ghost);
  command_toggle(ui, "toggle_grid", view.grid);
  ImGui::SameLine(left + half);
  command_toggle(ui, "toggle_theme", view.dark);
  command_toggle(ui, "toggle_orthographic", ui.workspace.camera.pose().orthographic);
  ImGui::SameLine(left + half);
  command_toggle(ui, "toggle_axes", view.axes);
  command_toggle(ui, "toggle_deformed", view.deformed);
  ImGui::SameLine(left + half);
  command_toggle(ui, "toggle_z_up", ui.workspace.camera.pose().up == scene::UpAxis::z);
  command_toggle(ui, "toggle_coarse_motion", scene::draws_coarsely(ui.workspace));
  const auto shading = static_cast<std::size_t>(view.shading);
  command_choice(ui, {"shading_clay", "shading_porcelain", "shading_jade", "shading_file"}, shading);
  command_choice(ui, {"shading_checker", "shading_normals", "shading_zebra"}, shading - 4);
  command_row(ui, {"view_front", "view_right", "view_top"});
  command_row(ui, {"view_back", "view_left", "view_bottom"});
  command_row(ui, {"view_home", "frame_all", "help"});
}

}  // namespace viete::ui
