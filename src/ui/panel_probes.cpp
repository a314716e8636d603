// The Probes panel: placing them, and where each part of their motion acts.
#include <algorithm>
#include <cmath>

#include "scene/document/probes.h"
#include "scene/workspace/command_conditions.h"
#include "ui/choice_list.h"
#include "ui/format.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

constexpr float probe_label = 76;

// Percent of the model's diagonal, on a scale where small ones have room too; the value stands beside it.
bool radius_slider(const Context& ui, const std::string& name, double& radius, bool used) {
  constexpr float value_width = 44;
  const scene::Document& document = ui.workspace.document;
  const double unit = 0.01 * document.space.diagonal();
  auto percent = static_cast<float>(radius / unit);
  const auto least = static_cast<float>(scene::least_probe_radius(document) / unit);
  const auto most = static_cast<float>(scene::largest_probe_radius(document) / unit);
  const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
  ImGui::BeginDisabled(!used);
  ImGui::SetNextItemWidth(-value_width);
  constexpr auto flags =
      ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoInput;
  const auto draw = [&] {
    return ImGui::SliderFloat(("##" + name).c_str(), &percent, least, most, "", flags);
  };
  const Slid slid = slider(ui, name, percent, least, most, draw, used);
  hint(
      "How far it reaches at rest, in percent of the model's diagonal. The circle in the view is the largest "
      "of the three.");
  value_beside(right, std::to_string(std::lround(percent)) + " %");
  ImGui::EndDisabled();
  if (slid.moved) radius = unit * static_cast<double>(std::round(percent));
  if (slid.typed)
    radius = std::clamp(unit * *slid.typed, scene::least_probe_radius(document),
                        scene::largest_probe_radius(document));
  return slid.moved || slid.typed;
}

void influence(const Context& ui, const char* label, const char* name, scene::Part part) {
  scene::Document& document = ui.workspace.document;
  scene::Influence shown = document.probes.all[document.selection.indices().front()].*part;
  row_label(label, probe_label);
  const std::string prefix = std::string("probe_") + name;
  constexpr float falloff_width = 92;
  ImGui::SetNextItemWidth(falloff_width);
  const auto falloff = entry_list(ui, prefix, scene::all_falloffs(), shown.falloff);
  ImGui::SameLine();
  const bool moved =
      radius_slider(ui, prefix + "_radius", shown.radius, shown.falloff != scene::Falloff::none);
  if (falloff) scene::set_falloff(document, part, *falloff);
  if (moved) scene::set_radius(document, part, shown.radius);
}

// How near to the shapes of the list pins leave the model.
void freedom(const Context& ui) {
  constexpr float value_width = 44;
  double& value = ui.workspace.handling.freedom;
  row_label("Freedom", probe_label);
  const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
  auto percent = static_cast<float>(100 * value);
  ImGui::SetNextItemWidth(-value_width);
  const Slid slid = slider(ui, "pin_freedom", 100 * value, 0, 100, [&] {
    return ImGui::SliderFloat("##pin_freedom", &percent, 0, 100, "", ImGuiSliderFlags_NoInput);
  });
  if (slid.moved) value = 0.01 * std::round(static_cast<double>(percent));
  if (slid.typed) value = 0.01 * *slid.typed;
  hint("How far pins take the model off the shapes of the list: 0 % as these do, 100 % as rigid as can be.");
  value_beside(right, std::to_string(std::lround(100 * value)) + " %");
}

void mix(const Context& ui) {
  scene::Document& document = ui.workspace.document;
  row_label("Together", probe_label);
  ImGui::SetNextItemWidth(-1);
  const auto chosen = entry_list(ui, "probe_mix", scene::all_probe_mixes(), document.probes.mix);
  if (chosen) scene::set_mix(document, *chosen);
}

}  // namespace

void panel_probes(const Context& ui) {
  const scene::Document& document = ui.workspace.document;
  const std::size_t probes = document.probes.all.size();
  if (probes == 0) return;
  const bool open = section(ui, "Probes", false);
  section_note(ui, count(probes));
  if (!open) return;
  command_row(ui, {"mirror_probe", "remove_probe"});
  const bool selected = document.selection.kind() == scene::ElementKind::probe && !document.selection.empty();
  if (scene::has_pins(document)) freedom(ui);
  if (selected && scene::has_pins_selected(ui.workspace)) {
    command_toggle(ui, "toggle_pulls");
  } else if (selected) {
    influence(ui, "Turns", "turn", &scene::Probe::turn);
    influence(ui, "Stretches", "stretch", &scene::Probe::stretch);
    influence(ui, "Moves", "move", &scene::Probe::move);
  } else {
    note(ui, document.selection.kind() == scene::ElementKind::probe
                 ? "Click a probe in the view to select it."
                 : "Press 4 and click a probe to select it.");
  }
  if (!std::ranges::all_of(document.probes.all, [](const scene::Probe& p) { return p.pin.has_value(); }))
    mix(ui);
  if (!selected) return;
  command_row(ui, {"reset_selected", "replace_probe"});
  const auto& indices = document.selection.indices();
  const bool locked = std::ranges::all_of(indices, [&](auto i) { return document.probes.all[i].locked; });
  command_toggle(ui, "toggle_locked", locked);
}

}  // namespace viete::ui
