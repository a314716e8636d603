// Position of the selection, its pivot, axes, mirror and soft selection.
#include "scene/document/elements.h"
#include "ui/choice_list.h"
#include "ui/format.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

constexpr float transform_label = 56;

void label_row(const Context& ui, const char* text) {
  ImGui::AlignTextToFramePadding();
  text_in(ui.colors.faint, text);
  ImGui::SameLine(transform_label + ImGui::GetStyle().WindowPadding.x);
}

float half_of_rest() {
  return 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
}

void pivot_row(const Context& ui) {
  const scene::Handling& handling = ui.workspace.handling;
  label_row(ui, "Pivot");
  const float width = half_of_rest();
  choice_list(ui, "pivot", std::optional(handling.pivot), width);
  ImGui::SameLine();
  choice_list(ui, "axes", std::optional(handling.axes), width);
}

std::string pairs_text(const scene::KnownMirror& known) {
  if (!known.mirror) return "";
  const std::size_t without = known.mirror->unpaired();
  return without == 0 ? "all paired" : count(without) + " unpaired";
}

void mirror_row(const Context& ui) {
  scene::Workspace& w = ui.workspace;
  label_row(ui, "Mirror");
  const float width = half_of_rest();
  choice_list(ui, "mirror", std::optional(w.handling.mirror), width);
  w.interaction.show_partners = ImGui::IsItemHovered() && w.mirror.mirror.has_value();
  ImGui::SameLine();
  const float right = ImGui::GetCursorScreenPos().x + width;
  const bool lacks = w.mirror.mirror && w.mirror.mirror->unpaired() > 0;
  text_right(ui, right, pairs_text(w.mirror), lacks ? ui.colors.warn : ui.colors.faint,
             ImGui::GetCursorScreenPos().y + ImGui::GetStyle().FramePadding.y);
  ImGui::NewLine();
  if (lacks) command_row(ui, {"make_symmetric_cage"});
}

// How far it reaches, in the file's units.
void soft_radius(const Context& ui, float width) {
  scene::SoftSelection& soft = ui.workspace.handling.soft;
  const double diagonal = ui.workspace.document.space.diagonal();
  auto value = static_cast<float>(soft.radius);
  ImGui::SetNextItemWidth(width);
  constexpr auto flags =
      ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput | ImGuiSliderFlags_Logarithmic;
  const std::string shown = length(soft.radius * diagonal);
  std::string format;  // a percent sign would be read as one of ImGui's
  for (const char c : shown) format += c == '%' ? "%%" : std::string(1, c);
  constexpr double least = scene::SoftSelection::least_radius;
  const auto draw = [&] {
    return ImGui::SliderFloat("##soft_radius", &value, static_cast<float>(least), 1, format.c_str(), flags);
  };
  const Slid slid =
      slider(ui, "soft_radius", soft.radius * diagonal, least * diagonal, diagonal, draw, soft.on);
  if (slid.moved) soft.radius = std::max(least, static_cast<double>(value));
  if (slid.typed) soft.radius = std::clamp(*slid.typed / diagonal, least, 1.0);
  hint("How far from the selection something still moves. During a drag the wheel changes it.");
}

void soft_rows(const Context& ui) {
  const scene::SoftSelection& soft = ui.workspace.handling.soft;
  const float left = ImGui::GetCursorPosX(), column = left + transform_label;
  command_toggle(ui, "toggle_soft", soft.on);
  ImGui::SameLine(column);
  ImGui::BeginDisabled(!soft.on);
  soft_radius(ui, -1);
  ImGui::SetCursorPosX(column);
  const float width = half_of_rest();
  choice_list(ui, "soft_curve", std::optional(soft.curve), width);
  ImGui::SameLine();
  choice_list(ui, "soft_distance", std::optional(soft.distance), width);
  ImGui::EndDisabled();
}

// Shown while the section is folded.
std::string transform_text(const scene::Workspace& w) {
  std::string text(scene::entry_of(w.handling.pivot).label);
  if (scene::mirror_of(w)) text += ", mirrored";
  if (w.handling.soft.on) text += ", soft";
  return text;
}

}  // namespace

void panel_transform(const Context& ui) {
  if (!ui.workspace.document.is_movable()) return;
  const bool open = section(ui, "Transform", false);
  section_note(ui, transform_text(ui.workspace));
  if (!open) return;
  const scene::Selection& selection = ui.workspace.document.selection;
  value_row(ui, "Selected",
            count(selection.size()) + " of " +
                count(scene::element_count(ui.workspace.document, selection.kind())));
  transform_fields(ui);
  pivot_row(ui);
  if (!ui.workspace.document.has_cage()) return;
  mirror_row(ui);
  soft_rows(ui);
  command_row(ui, {"bend", "twist", "taper", "push"});
  command_row(ui, {"smooth", "relax", "flatten"});
}

}  // namespace viete::ui
