// What to select, how, and sets of it by name.
#include <algorithm>
#include <optional>
#include <string>

#include "scene/document/selection_sets.h"
#include "scene/workspace/command_conditions.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

// One row a set. What is done to the list is done after it was drawn.
void sets(const Context& ui) {
  scene::Document& document = ui.workspace.document;
  const auto& all = document.groups.sets;
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const float button = 64, close = ImGui::GetFrameHeight();
  const float width = ImGui::GetContentRegionAvail().x - button - close - 2 * gap;
  std::optional<std::size_t> selected, removed, renamed;
  std::string name;
  ImGui::BeginDisabled(scene::in_hand(ui.workspace));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string id = "set/" + std::to_string(i);
    if (const auto typed = name_field(ui, id, all[i].name, width, "The name of the set; type another one"))
      renamed = i, name = *typed;
    ImGui::SameLine(0, gap);
    if (ImGui::Button(("Select##" + id).c_str(), {button, 0})) selected = i;
    record(ui, id + "/select");
    hint("Select this set; Shift adds it, Ctrl takes it out");
    ImGui::SameLine(0, gap);
    if (ImGui::Button(("x##" + id).c_str(), {close, 0})) removed = i;
    record(ui, id + "/remove");
    hint("Delete this set; what it holds stays, and undo brings it back");
  }
  ImGui::EndDisabled();
  if (renamed) scene::rename_set(document, *renamed, name);
  if (selected) scene::select_set(document, *selected, select_mode());
  if (removed) scene::remove_set(document, *removed);
  if (selected || removed) ui.workspace.interaction.hovered.reset();
}

}  // namespace

// What is used most; the rest is in the menu Select, in the palette and on keys.
void panel_select(const Context& ui) {
  if (!ui.workspace.document.has_cage() || !section(ui, "Select", false)) return;
  command_row(ui, {"select_all", "select_none", "invert_selection"});
  command_row(ui, {"select_more", "select_less", "save_set"});
  const float half = ImGui::GetCursorPosX() + 0.5f * ImGui::GetContentRegionAvail().x;
  command_toggle(ui, "toggle_select_visible");
  if (!ui.workspace.document.groups.hidden.empty()) {
    ImGui::SameLine(half);
    command_button(ui, "show_hidden", -1);
  }
  sets(ui);
}

}  // namespace viete::ui
