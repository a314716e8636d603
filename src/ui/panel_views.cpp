// The number of views, and the settings of each view.
#include <string>

#include "ui/choice_list.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/playing.h"

namespace viete::ui {

namespace {

void deformer_list(const Context& ui, const std::string& name, workspace::SplitView& side) {
  if (const auto preset = entry_list(ui, name, document::preset_of(side.deformer), "Custom"))
    side.deformer = document::chosen(*preset, ui.workspace.document.deformer());
}

void method_list(const Context& ui, const std::string& name, workspace::SplitView& side) {
  if (!begin_list(ui, name, method_label(side.method).c_str(), "")) return;
  for (const workspace::Method method : analysis::compared_methods) {
    const std::string label = method_label(method);
    if (list_entry(ui, label, name + '_' + label, side.method == method, "")) side.method = method;
  }
  ImGui::EndCombo();
}

void map_list(const Context& ui, const std::string& name, workspace::SplitView& side) {
  side.field = entry_list(ui, name, std::optional(side.field)).value_or(side.field);
}

void side_rows(const Context& ui, std::size_t number, workspace::SplitView& side) {
  constexpr float label = 74;
  const std::string name = "side/" + std::to_string(number);
  const auto row = [&](const char* words, auto list, const char* what) {
    row_label(words, label);
    ImGui::SetNextItemWidth(-1);
    list(ui, name + what, side);
  };
  ImGui::PushFont(ui.fonts.strong);
  note(ui, "View " + std::to_string(number + 1), ui.colors.text);
  ImGui::PopFont();
  if (ui.workspace.document.has_cage()) row("Deformer", deformer_list, "/deformer");
  if (side.deformer.exponential()) row("Method", method_list, "/method");
  row("Map", map_list, "/map");
  if (side.other_blending || workspace::has_blended_pose(ui.workspace)) {
    const char* const words =
        ui.workspace.document.timeline().linear ? "In log space" : "Linear interpolation";
    ImGui::Checkbox((std::string(words) + "##" + name).c_str(), &side.other_blending);
    record(ui, name + "/lines");
    hint("Interpolate differently from the first view, to compare log space and linear interpolation.");
  }
  if (!side.problem.empty()) note(ui, side.problem, ui.colors.bad);
}

}  // namespace

void panel_views(const Context& ui) {
  workspace::Split& split = ui.workspace.view.split;
  if (!ui.workspace.document.model().surface || !section(ui, "Views", false)) return;
  command_choice(ui, {"views_1", "views_2", "views_3", "views_4"}, split.count() - 1);
  if (!split.on()) return note(ui, "Split the view to compare deformers, methods and maps of one pose.");
  command_toggle(ui, "toggle_linked_cameras");
  for (std::size_t view = 1; view < split.count(); ++view) side_rows(ui, view, split.views[view]);
}

}  // namespace viete::ui
