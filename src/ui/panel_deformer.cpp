#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>

#include "scene/document/binding_plan.h"
#include "scene/document/edit.h"
#include "scene/workspace/choice_commands.h"
#include "scene/workspace/command.h"
#include "ui/choice_picture.h"
#include "ui/panel_timings.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

using scene::entry;

constexpr float chooser_label = 84;
constexpr const char* custom = "Custom";

// Side effects of the highlighted entry, and its cost.
std::string consequences(const scene::Workspace& w, const scene::Scheme& next, std::string_view chosen) {
  const scene::Scheme& now = w.document.scheme;
  std::string text;
  const auto say = [&](const char* what, std::string_view before, std::string_view after) {
    if (before != after && after != chosen)
      text += (text.empty() ? "" : "\n") + std::string(what) + ": " + std::string(after);
  };
  say("Weights", entry(now.weighting.weights).label, entry(next.weighting.weights).label);
  say("Blend", entry(now.blend).label, entry(next.blend).label);
  if (w.document.has_cage() && now.weighting != next.weighting)
    text += (text.empty() ? "" : "\n") + scene::text(scene::binding_plan(w.document, next.weighting)) +
            " of memory.";
  return text;
}

// An entry of a chooser's list.
template <class Entry>
void choice(const Context& ui, const Entry& choice, bool chosen) {
  scene::Workspace& w = ui.workspace;
  const scene::Command& command = *scene::find_command(scene::choice_command_name(choice.value));
  if (chosen) ImGui::PushStyleColor(ImGuiCol_Text, ui.colors.accent);
  if (ImGui::Selectable(command.brief.data(), chosen)) command.run(w);
  if (chosen) ImGui::PopStyleColor();
  record(ui, command.name.data());
  const scene::Scheme next = scene::chosen(choice.value, w.document.scheme);
  choice_hint(ui, choice.value, consequences(w, next, choice.label));
}

// A drop-down list of a table; without a label it fills the line.
template <class Entry, class Value>
void chooser(const Context& ui, const char* name, const char* label, std::span<const Entry> table,
             std::optional<Value> chosen) {
  if (*label) row_label(label, chooser_label);
  ImGui::SetNextItemWidth(-1);
  const std::string id = std::string("##") + name;
  const char* shown = chosen ? entry(*chosen).label.data() : custom;
  const bool open = ImGui::BeginCombo(id.c_str(), shown, ImGuiComboFlags_HeightLarge);
  record(ui, name);
  if (!open && !chosen) return hint("Weights and blend chosen separately; see Custom deformer in Analysis.");
  if (!open) return choice_hint(ui, *chosen);
  for (const Entry& e : table) choice(ui, e, e.value == chosen);
  ImGui::EndCombo();
}

struct Number {
  double value, least, most;
};

// A slider with discrete stops and its value, which can be typed as a number.
Slid stops(const Context& ui, const char* name, const char* label, int& stop, int last, bool used,
           const Number& number, const std::string& value, const std::string& hint_text) {
  ImGui::BeginDisabled(!used);
  row_label(label, chooser_label);
  constexpr float value_width = 84;
  const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
  ImGui::SetNextItemWidth(-value_width);
  const std::string id = std::string("##") + name;
  const auto draw = [&] {
    return ImGui::SliderInt(id.c_str(), &stop, 0, last, "", ImGuiSliderFlags_NoInput);
  };
  const Slid slid = slider(ui, name, number.value, number.least, number.most, draw, used);
  ImGui::EndDisabled();
  hint(hint_text);
  ImGui::BeginDisabled(!used);
  value_beside(right, value);
  ImGui::EndDisabled();
  return slid;
}

// A slider of these shares: returns the one moved to, or typed in percent.
std::optional<double> share_slider(const Context& ui, const char* name, const char* label, double share,
                                   std::span<const double> all, const char* hint_text) {
  const auto above = std::ranges::lower_bound(all, share);
  int stop = static_cast<int>(std::min(above, all.end() - 1) - all.begin());
  const Slid slid =
      stops(ui, name, label, stop, static_cast<int>(all.size()) - 1, true,
            {100 * share, 100 * all.front(), 100 * all.back()}, scene::text_of_percent(share), hint_text);
  if (slid.typed) return std::clamp(0.01 * *slid.typed, all.front(), all.back());
  return slid.moved ? std::optional(all[static_cast<std::size_t>(stop)]) : std::nullopt;
}

void radius_slider(const Context& ui) {
  constexpr std::array radii = {0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.7, 1.0};
  scene::Document& document = ui.workspace.document;
  const auto radius = share_slider(
      ui, "radius", "Radius", document.scheme.weighting.radius, radii,
      "Distance where weights become zero, in percent of the cage's size. Vertices beyond it stay at rest.");
  if (radius) scene::set_radius(document, *radius);
}

bool amount_slider(const Context& ui, const char* name, const char* label, double& amount, bool used,
                   const std::string& what) {
  constexpr double step = 0.05;
  const double shown = used ? amount : 1;
  int stop = static_cast<int>(std::lround(shown / step));
  const std::string percent = std::to_string(std::lround(100 * shown)) + " %";
  const Slid slid = stops(ui, name, label, stop, static_cast<int>(std::lround(scene::largest_amount / step)),
                          used, {100 * shown, 0, 100 * scene::largest_amount}, percent,
                          used ? what : "Not available: this deformer does not use rotation or stretch.");
  if (slid.moved) amount = std::round(100 * step * stop) / 100;
  if (slid.typed) amount = 0.01 * *slid.typed;
  return slid.moved || slid.typed;
}

void amount_sliders(const Context& ui) {
  scene::Document& document = ui.workspace.document;
  const bool used = document.scheme.has_maps();
  scene::Amounts amounts = document.scheme.amounts;
  const bool turned =
      amount_slider(ui, "turn", "Rotation", amounts.turn, used,
                    "Scales the blended rotation. 0 % ignores the cage's rotation; 100 % is normal.");
  const bool stretched = amount_slider(
      ui, "stretch", "Stretch", amounts.stretch, used,
      "Scales the logarithm of the blended stretch. 0 % keeps the thickness of the model; 100 % is normal.");
  if (turned || stretched) scene::set_amounts(document, amounts);
}

void holding(const Context& ui) {
  constexpr std::array radii = {0.0, 0.01, 0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2};
  constexpr std::array weights = {0.0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0};
  scene::Document& document = ui.workspace.document;
  scene::Holding shown = document.scheme.holding;
  const auto pins = share_slider(ui, "pins", "Pins", shown.radius, radii,
                                 "Attach vertices within this distance of the cage, in percent of its size. "
                                 "0 %: only the nearest triangle of each element.");
  const auto held = share_slider(ui, "hold", "Hold", shown.weight, weights,
                                 "How strongly each vertex is drawn to its unstitched position.");
  shown = {pins.value_or(shown.radius), held.value_or(shown.weight)};
  if (pins || held) scene::set_holding(document, shown);
}

void stitching(const Context& ui) {
  scene::Document& document = ui.workspace.document;
  const scene::Condition& condition = scene::find_command("toggle_stitched")->enabled;
  const bool possible = condition(ui.workspace), stitched = document.scheme.stitched();
  row_label("Shape", chooser_label);
  ImGui::BeginDisabled(!possible);
  command_toggle(ui, "toggle_stitched", stitched);
  ImGui::EndDisabled();
  if (!possible) return hint(std::string(condition.otherwise));
  if (!stitched) return;
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  int iterations = document.scheme.iterations;
  const Slid slid = slider(ui, "iterations", iterations, 1, scene::most_iterations, [&] {
    return ImGui::SliderInt("##iterations", &iterations, 1, scene::most_iterations,
                            iterations == 1 ? "%d iteration" : "%d iterations",
                            ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput);
  });
  if (slid.typed) iterations = static_cast<int>(std::lround(*slid.typed));
  if (slid.moved || slid.typed) scene::set_iterations(document, iterations);
  hint(
      "Number of solves per frame. Each further solve refits the triangles' rotations, which spreads bends "
      "more evenly.");
  holding(ui);
}

}  // namespace

void panel_custom(const Context& ui) {
  if (!section(ui, "Custom deformer", false)) return;
  const scene::Scheme& scheme = ui.workspace.document.scheme;
  if (const auto stage = frame_formula(ui)) ui.workspace.interaction.stage = stage;
  chooser(ui, "weights", "Weights", scene::all_weights(), std::optional(scheme.weighting.weights));
  chooser(ui, "blend", "Blend", scene::all_blends(), std::optional(scheme.blend));
  stitching(ui);
}

void panel_deformer(const Context& ui) {
  const scene::Scheme& scheme = ui.workspace.document.scheme;
  heading(ui, "Deformer");
  chooser(ui, "way", "", scene::all_ways(), scene::way_of(scheme));
  if (scheme.weighting.partial()) radius_slider(ui);
  amount_sliders(ui);
}

}  // namespace viete::ui
