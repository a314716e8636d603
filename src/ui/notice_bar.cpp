#include <cfloat>
#include <ctime>

#include "scene/files/recovery.h"
#include "scene/workspace/command.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

std::string name_of(const scene::Leftover& leftover) {
  return leftover.name + ", " + scene::when(leftover.time, std::time(nullptr));
}

void hint_at(const scene::Leftover& leftover) {
  const std::string began = leftover.first_edit.empty() ? "" : "First edit: " + leftover.first_edit + "\n";
  hint(began + "Folder: " + leftover.folder.string());
}

// Beside the item before, or below it where the window is too narrow.
void flow(float width) {
  const float end = ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + width;
  if (end <= ImGui::GetWindowPos().x + ImGui::GetWindowSize().x - ImGui::GetStyle().WindowPadding.x)
    ImGui::SameLine();
}

float width_of(const std::string& label) {
  return ImGui::CalcTextSize(label.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x;
}

// The newest one, which Restore opens, and how many there are besides.
void leftover_words(const Context& ui) {
  const auto& leftovers = ui.workspace.leftovers;
  const std::size_t more = leftovers.size() - 1;
  const std::string text = "Recovered edits: " + name_of(leftovers.front()) +
                           (more == 0 ? "" : " and " + std::to_string(more) + " more");
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(shortened(text, ImGui::GetContentRegionAvail().x).c_str());
  hint_at(leftovers.front());
}

// As the last thing that is seen.
void farewell(const Context& ui) {
  const Window window("Farewell", {.at = middle_of_view(ui), .padding = {24, 16}}, sized_flags);
  ImGui::TextUnformatted("Unsaved edits are kept; the next start offers to bring them back.");
  record(ui, "farewell");
}

}  // namespace

float notice_room(const Context& ui) {
  constexpr float tools = 64, least = 180;  // tools at the left; as much at the right, so that it is centred
  return std::max(least, ui.workspace.viewport.size.x - 2 * tools);
}

// A row of its own below the menu bar, above the columns and the view.
void notice_bar(const Context& ui) {
  auto& w = ui.workspace;
  if (w.farewell) farewell(ui);
  if (!w.attended) return;
  w.notice_height = 0;
  if (!w.offers_leftovers || w.leftovers.empty()) return;
  const float top = w.view.panels ? scene::PanelLayout::menu_height : 0;
  const ImVec2 size(w.viewport.window.x, 0);
  ImGui::SetNextWindowSizeConstraints(size, {size.x, FLT_MAX});
  const Window window("Notice", {.at = {0, top}, .pivot = {0, 0}, .rounding = 0}, card_flags);
  leftover_words(ui);
  for (const char* command : {"restore_leftover", "discard_leftovers", "put_off_leftovers"}) {
    flow(width_of(scene::find_command(command)->brief));
    command_button(ui, command);
  }
  w.notice_height = ImGui::GetWindowSize().y;
}

}  // namespace viete::ui
