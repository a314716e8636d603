#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

void panel_display(const Context& ui) {
  if (!section(ui, "Display", false)) return;
  const float half = 0.5f * ImGui::GetContentRegionAvail().x;
  const float left = ImGui::GetCursorPosX();
  constexpr const char* pairs[][2] = {{"toggle_model", "toggle_wireframe"},
                                      {"toggle_cage", "toggle_ghost"},
                                      {"toggle_grid", "toggle_theme"},
                                      {"toggle_orthographic", "toggle_axes"},
                                      {"toggle_deformed", "toggle_z_up"}};
  for (const auto& [one, other] : pairs) {
    command_toggle(ui, one);
    ImGui::SameLine(left + half);
    command_toggle(ui, other);
  }
  command_toggle(ui, "toggle_coarse_motion");
  const auto shading = static_cast<std::size_t>(ui.workspace.view.shading);
  command_choice(ui, {"shading_clay", "shading_porcelain", "shading_jade", "shading_file"}, shading);
  command_choice(ui, {"shading_checker", "shading_normals", "shading_zebra"}, shading - 4);
}

}  // namespace viete::ui
