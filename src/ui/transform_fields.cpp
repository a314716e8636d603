// In the Cage panel: what is selected, with which tool, and numbers to type.
#include <cstdio>

#include "scene/elements.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

constexpr const char* format = "%.5g";

std::string printed(double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

struct Fields {
  const char* label;
  const char* hint;
  glm::dvec3 values;
};

Fields fields(const scene::Document& document, scene::Tool tool) {
  if (tool == scene::Tool::rotate)
    return {"Rotate by (degrees)", "Type an angle and press Enter: rotates about this axis", {0, 0, 0}};
  if (tool == scene::Tool::scale)
    return {"Scale by", "Type a factor and press Enter: scales along this axis", {1, 1, 1}};
  const glm::dvec3 center = document.selection.empty() ? glm::dvec3(0) : scene::selection_center(document);
  return {"Centre", "Where the centre of the selection is; type a place and press Enter", center};
}

void apply(scene::Document& document, scene::Tool tool, int axis, double value) {
  scene::Transform transform;
  transform.pivot = scene::selection_center(document);
  if (tool == scene::Tool::rotate) {
    transform.axis = glm::dvec3(0);
    transform.axis[axis] = 1;
    transform.degrees = value;
  } else if (tool == scene::Tool::scale) {
    transform.factors[axis] = value;
  } else {
    transform.shift[axis] = value - transform.pivot[axis];
    tool = scene::Tool::move;
  }
  scene::transform_selection(document, tool, transform);
}

// An Enter that changes no digit changes nothing: the field shows fewer of them than the number has.
void field(const Context& ui, const Fields& fields, int axis, float width) {
  const std::string name = std::string("transform_") + static_cast<char>('x' + axis);
  double value = fields.values[axis];
  ImGui::SetNextItemWidth(width);
  constexpr auto flags = ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll;
  const bool entered = ImGui::InputDouble(("##" + name).c_str(), &value, 0, 0, format, flags);
  record(ui, name, !ui.workspace.document.selection.empty());
  hint(fields.hint);
  if (entered && printed(value) != printed(fields.values[axis]))
    apply(ui.workspace.document, ui.workspace.tool, axis, value);
}

}  // namespace

void transform_fields(const Context& ui) {
  const auto& w = ui.workspace;
  const auto kind = static_cast<std::size_t>(w.document.selection.kind());
  command_choice(ui, {"select_vertices", "select_edges", "select_faces"}, kind);
  command_choice(ui, {"tool_select", "tool_move", "tool_rotate", "tool_scale"},
                 static_cast<std::size_t>(w.tool));
  const Fields shown = fields(w.document, w.tool);
  note(ui, shown.label);
  ImGui::BeginDisabled(w.document.selection.empty() || w.hand.drag);
  const float letter = ImGui::CalcTextSize("X").x + ImGui::GetStyle().ItemInnerSpacing.x;
  const float spacing = ImGui::GetStyle().ItemSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - 3 * letter - 2 * spacing) / 3;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0) ImGui::SameLine(0, spacing);
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(ui.colors.axis[axis]), "%c", 'X' + axis);
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    field(ui, shown, axis, width);
  }
  ImGui::EndDisabled();
}

}  // namespace viete::ui
