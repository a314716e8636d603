#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>

#include "document/document.h"
#include "document/edit.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/command.h"
#include "workspace/command_tables.h"

namespace viete::ui {

namespace {

using base::entry_of;

constexpr float chooser_label = 84;

// Lists the settings that `next` would change, except the setting `chosen`. Adds the memory for binding.
std::string consequences(const workspace::Workspace& w, const document::Deformer& next,
                         std::string_view chosen) {
  const document::Deformer& now = w.document.deformer();
  std::string text;
  const auto say = [&](const char* what, std::string_view before, std::string_view after) {
    if (before != after && after != chosen) text += '\n' + std::string(what) + ": " + std::string(after);
  };
  say("Weights", entry_of(now.weighting.weights).label, entry_of(next.weighting.weights).label);
  say("Blend", entry_of(now.blend).label, entry_of(next.blend).label);
  if (w.document.has_cage() && now.weighting != next.weighting)
    text += '\n' + document::binding_plan(w.document, next.weighting) + " of memory.";
  return text;
}

template <class Value>
void choice(const Context& ui, Value value, bool chosen) {
  workspace::Workspace& w = ui.workspace;
  const workspace::Command& command = *workspace::find_command(workspace::choice_command_name(value));
  if (chosen) ImGui::PushStyleColor(ImGuiCol_Text, ui.colors.accent);
  if (list_entry(ui, command.brief, command.name, chosen, "")) command.run(w);
  if (chosen) ImGui::PopStyleColor();
  const document::Deformer next = document::chosen(value, w.document.deformer());
  hint(std::string(entry_of(value).hint) + consequences(w, next, entry_of(value).label));
}

// A drop-down list of all values. Without a label, the list fills the line.
template <class Value>
void chooser(const Context& ui, const char* name, const char* label, std::optional<Value> chosen) {
  if (*label) row_label(label, chooser_label);
  ImGui::SetNextItemWidth(-1);
  const char* const shown = chosen ? entry_of(*chosen).label.data() : "Custom";
  const std::string_view tip =
      chosen ? entry_of(*chosen).hint
             : "Weights and blend were chosen separately, in Analysis, Custom deformer.";
  if (!begin_list(ui, name, shown, std::string(tip))) return;
  for (const Value value : base::all_values<Value>()) choice(ui, value, value == chosen);
  ImGui::EndCombo();
}

// A slider that stops only at the fractions in `stops`. Other values can be typed in percent.
void number_slider(const Context& ui, const char* name, std::span<const double> stops) {
  document::Document& document = ui.workspace.document;
  document::Deformer deformer = document.deformer();
  const auto& number = document::number(name);
  const bool used = number.need.met(deformer);
  double& value = number.of(deformer);
  const double shown = used ? value : 1;
  const auto above = std::ranges::lower_bound(stops, shown);
  int stop = static_cast<int>(std::min(above, stops.end() - 1) - stops.begin());
  ImGui::BeginDisabled(!used);
  row_label(number.label.data(), chooser_label);
  constexpr float value_width = 84;
  const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
  ImGui::SetNextItemWidth(-value_width);
  const std::string id = std::string("##") + name;
  const auto draw = [&] {
    return ImGui::SliderInt(id.c_str(), &stop, 0, static_cast<int>(stops.size()) - 1, "",
                            ImGuiSliderFlags_NoInput);
  };
  const Slid slid = slider(ui, name, 100 * shown, 100 * number.least, 100 * number.largest, draw, used);
  ImGui::EndDisabled();
  hint((used ? std::string(number.hint) : "Not available: " + std::string(number.need.problem)) + '.');
  ImGui::BeginDisabled(!used);
  value_beside(right, document::text_of_percent(shown));
  ImGui::EndDisabled();
  if (!slid.moved && !slid.typed) return;
  value = slid.typed ? 0.01 * *slid.typed : stops[static_cast<std::size_t>(stop)];
  document::set_radius(document, deformer.weighting.radius);
  document::set_amounts(document, deformer.amounts);
  document::set_holding(document, deformer.holding);
}

void arap(const Context& ui) {
  document::Document& document = ui.workspace.document;
  const workspace::Condition& condition = workspace::find_command("toggle_arap")->enabled;
  const bool possible = condition(ui.workspace), stitched = document.deformer().stitched();
  row_label("Solve", chooser_label);
  ImGui::BeginDisabled(!possible);
  command_toggle(ui, "toggle_arap", stitched);
  ImGui::EndDisabled();
  if (!possible) return hint(std::string(condition.otherwise));
  if (!stitched) return;
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  int iterations = document.deformer().iterations;
  const Slid slid = slider(ui, "iterations", iterations, 1, document::most_iterations, [&] {
    return ImGui::SliderInt("##iterations", &iterations, 1, document::most_iterations,
                            iterations == 1 ? "%d iteration" : "%d iterations",
                            ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput);
  });
  if (slid.typed) iterations = static_cast<int>(std::lround(*slid.typed));
  if (slid.moved || slid.typed) document::set_iterations(document, iterations);
  hint("Number of solves per frame. More solves distribute bends more evenly, but take longer.");
  number_slider(ui, "attach", std::array{0.0, 0.01, 0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2});
  number_slider(ui, "hold", std::array{0.0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0});
}

}  // namespace

void panel_custom(const Context& ui) {
  if (!section(ui, "Custom deformer", false)) return;
  const document::Deformer& deformer = ui.workspace.document.deformer();
  chooser(ui, "weights", "Weights", std::optional(deformer.weighting.weights));
  chooser(ui, "blend", "Blend", std::optional(deformer.blend));
  arap(ui);
}

void panel_deformer(const Context& ui) {
  const document::Deformer& deformer = ui.workspace.document.deformer();
  heading(ui, "Deformer");
  chooser(ui, "deformer", "", document::preset_of(deformer));
  constexpr std::array radii{0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.7, 1.0};
  if (deformer.weighting.partial()) number_slider(ui, "radius", radii);
  std::array<double, 41> amounts;
  for (std::size_t i = 0; i < amounts.size(); ++i) amounts[i] = 5 * static_cast<double>(i) / 100;
  for (const char* name : {"rotation", "stretch"}) number_slider(ui, name, amounts);
}

}  // namespace viete::ui
