#include <ctime>

#include "scene/recovery.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

std::string notice(const scene::Workspace& w) {
  const scene::Leftover& leftover = w.leftovers.front();
  const std::size_t others = w.leftovers.size() - 1;
  const std::string more = others > 0 ? "  (and " + std::to_string(others) + " more)" : "";
  return "Unsaved edits of " + leftover.name + ", " + scene::when(leftover.time, std::time(nullptr)) + more;
}

}  // namespace

// A line at the top of the view that waits and stops nothing.
void notice_bar(const Context& ui) {
  const auto& w = ui.workspace;
  if (w.leftovers.empty() || w.hand.drag || w.hand.box) return;
  const auto& v = w.viewport;
  ImGui::SetNextWindowPos({v.origin.x + 0.5f * v.size.x, v.origin.y + 12}, ImGuiCond_Always, {0.5f, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 8);
  ImGui::Begin("Notice", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing |
                   ImGuiWindowFlags_NoNav);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(notice(w).c_str());
  hint(w.leftovers.front().file.string());
  for (const char* command : {"restore_leftover", "discard_leftover", "put_off_leftover"}) {
    ImGui::SameLine();
    command_button(ui, command);
    if (w.leftovers.empty()) break;
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace viete::ui
