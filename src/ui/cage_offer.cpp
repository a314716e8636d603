// In the middle of the view of a model without a cage: ways to get one.
#include <algorithm>

#include "scene/cage_making.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

bool shows(const scene::Workspace& w) {
  return w.offer_cage && w.document.model.surface && !w.document.is_movable() && !w.making.open &&
         !w.loading.running && !w.browser.open && !w.question && w.view.panels && !w.view.help;
}

void line(const std::string& text, ImU32 color) {
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

}  // namespace

float cage_offer(const Context& ui, float bottom) {
  const scene::Workspace& w = ui.workspace;
  if (!shows(w)) return bottom;
  constexpr const char* what = "A cage is the coarse mesh around it that you drag.";
  const float width = std::max(320.0f, ImGui::CalcTextSize(what).x);
  const auto& v = w.viewport;
  ImGui::SetNextWindowPos({v.origin.x + 0.5f * v.size.x, bottom - 28}, ImGuiCond_Always, {0.5f, 1});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 8);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {16, 14});
  ImGui::Begin("Cage offer", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing |
                   ImGuiWindowFlags_NoNav);
  ImGui::PushFont(ui.fonts.strong);
  line("This model has no cage yet", ui.colors.text);
  ImGui::PopFont();
  line(what, ui.colors.faint);
  ImGui::Dummy({width, 2});
  if (!w.document.cage_beside.empty()) {
    line(w.document.cage_beside.filename().string() + " lies beside it.", ui.colors.text);
    command_button(ui, "open_cage_beside", width);
  }
  command_button(ui, "make_cage", width);
  command_row(ui, {"open_cage", "hide_cage_offer"});
  const float top = ImGui::GetWindowPos().y;
  ImGui::End();
  ImGui::PopStyleVar(2);
  return top + 28;
}

}  // namespace viete::ui
