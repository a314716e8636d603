// The number of views, and the settings of each.
#include <optional>
#include <string>

#include "scene/workspace/playing.h"
#include "ui/choice_picture.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

void way_list(const Context& ui, const std::string& name, scene::SideView& side) {
  const auto now = scene::way_of(side.scheme);
  const bool open =
      ImGui::BeginCombo(("##" + name).c_str(), now ? scene::entry(*now).label.data() : "Custom");
  record(ui, name);
  if (!open) return;
  for (const auto& entry : scene::all_ways()) {
    if (ImGui::Selectable(entry.label.data(), now == entry.value))
      side.scheme = scene::chosen(entry.value, ui.workspace.document.scheme);
    record(ui, name + '_' + std::string(entry.name));
    hint(std::string(entry.sentence));
  }
  ImGui::EndCombo();
}

void method_list(const Context& ui, const std::string& name, scene::SideView& side) {
  const bool open = ImGui::BeginCombo(("##" + name).c_str(), method_label(side.method).c_str());
  record(ui, name);
  if (!open) return;
  for (const scene::Method method : scene::compared_methods) {
    if (ImGui::Selectable(method_label(method).c_str(), side.method == method)) side.method = method;
    record(ui, name + '_' + method_label(method));
  }
  ImGui::EndCombo();
}

void map_list(const Context& ui, const std::string& name, scene::SideView& side) {
  const bool open = ImGui::BeginCombo(("##" + name).c_str(), base::entry_of(side.field).label.data(),
                                      ImGuiComboFlags_HeightLargest);
  record(ui, name);
  if (!open) return;
  for (const base::Choice& choice : choices(side.field)) {
    const auto field = *base::value_of_word<lab::Field>(choice.word);
    if (ImGui::Selectable(choice.label.data(), side.field == field)) side.field = field;
    record(ui, name + '_' + std::string(choice.word));
    hint(std::string(choice.hint));
  }
  ImGui::EndCombo();
}

void side_rows(const Context& ui, std::size_t number, scene::SideView& side) {
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
  if (ui.workspace.document.has_cage()) row("Deformer", way_list, "/way");
  if (side.scheme.exponential()) row("Method", method_list, "/method");
  row("Map", map_list, "/map");
  if (side.other_blending || scene::has_blended_pose(ui.workspace)) {
    const char* const words =
        ui.workspace.document.timeline.straight ? "In log space" : "Linear interpolation";
    ImGui::Checkbox((std::string(words) + "##" + name).c_str(), &side.other_blending);
    record(ui, name + "/lines");
    hint("Use the other interpolation than the first view: linear or log space.");
  }
  if (!side.problem.empty()) note(ui, side.problem, ui.colors.bad);
}

}  // namespace

void panel_views(const Context& ui) {
  scene::Split& split = ui.workspace.split;
  if (!ui.workspace.document.model.surface || !section(ui, "Views", false)) return;
  command_choice(ui, {"views_1", "views_2", "views_3", "views_4"}, split.count() - 1);
  if (!split.on()) return note(ui, "Split the view to compare deformers, methods and maps of one pose.");
  command_toggle(ui, "toggle_linked_cameras");
  if (split.sides.size() == 1) command_toggle(ui, "toggle_wipe");
  for (std::size_t i = 0; i < split.sides.size(); ++i) side_rows(ui, i + 1, split.sides[i]);
}

}  // namespace viete::ui
