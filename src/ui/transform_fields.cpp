// In the Cage panel: what is selected, with which tool, and numbers to type.
#include <algorithm>
#include <cmath>

#include "scene/document/elements.h"
#include "scene/hand/placing.h"
#include "scene/workspace/pointer.h"
#include "ui/format.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

struct Fields {
  const char* label;
  const char* hint;
  glm::dvec3 values;
};

// How far along each of the axes.
glm::dvec3 along(const glm::dmat3& axes, const glm::dvec3& place) {
  return glm::transpose(axes) * place;
}

Fields fields(const scene::Workspace& w) {
  const scene::Tool tool = w.tool;
  if (tool == scene::Tool::rotate)
    return {"Rotate by (degrees)", "Type an angle and press Enter: rotates about this axis", {0, 0, 0}};
  if (tool == scene::Tool::scale)
    return {"Scale by", "Type a factor and press Enter: scales along this axis", {1, 1, 1}};
  glm::dvec3 place(0);
  if (!w.document.selection.empty()) {
    const scene::Anchor anchor = scene::grip_of(w).anchor;
    place = along(anchor.axes, anchor.center);
  }
  return {w.handling.pivot == scene::Pivot::median ? "Centre" : "Pivot",
          "Where the selection is, along the axes chosen below; type a place and press Enter", place};
}

void apply(scene::Workspace& workspace, int axis, double value) {
  scene::Document& document = workspace.document;
  scene::Tool tool = workspace.tool;
  scene::Transform transform;
  const scene::Grip grip = scene::grip_of(workspace);
  transform.pivot = grip.anchor.center;
  transform.axes = grip.anchor.axes;
  if (tool == scene::Tool::rotate) {
    transform.axis = grip.anchor.axes[axis];
    transform.degrees = std::clamp(value, -scene::most_degrees, scene::most_degrees);
    if (transform.degrees != value)
      workspace.messages.info("Turned by " + count(static_cast<std::size_t>(scene::most_degrees)) +
                              " degrees, the most at once");
  } else if (tool == scene::Tool::scale) {
    transform.factors[axis] = value;
  } else {
    const double way = value - along(grip.anchor.axes, grip.anchor.center)[axis];
    transform.shift = way * grip.anchor.axes[axis];
    tool = scene::Tool::move;
  }
  if (scene::transform_selection(document, tool, grip, transform)) return;
  workspace.messages.warn(tool == scene::Tool::rotate
                              ? "The cage has been turned round as often as it can be; nothing was changed"
                              : "That is too far away from the model to be drawn; nothing was moved");
}

void field(const Context& ui, const Fields& fields, int axis, float width) {
  const std::string name = std::string("transform_") + static_cast<char>('x' + axis);
  ImGui::SetNextItemWidth(width);
  const auto number = number_field(ui, name, fields.values[axis]);
  const bool enabled = !ui.workspace.document.selection.empty();
  record(ui, name, enabled);
  hint(fields.hint);
  if (number && enabled) apply(ui.workspace, axis, *number);
}

// As much room as the fields of the other tools take.
void brush_fields(const Context& ui) {
  scene::Brush& brush = ui.workspace.brush;
  command_row(ui, {"mask_clear", "mask_invert"});
  const float spacing = ImGui::GetStyle().ItemSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - spacing) / 2;
  constexpr auto flags = ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput;
  ImGui::SetNextItemWidth(width);
  float radius = brush.radius;
  constexpr float least = scene::Brush::least_radius, most = 150;
  const Slid reach = slider(ui, "brush_radius", radius, least, most, [&] {
    return ImGui::SliderFloat("##brush_radius", &radius, least, most, "%.0f px", flags);
  });
  if (reach.moved || reach.typed) brush.radius = static_cast<float>(reach.typed.value_or(radius));
  hint("How far the brush reaches in the picture. Shift and the wheel change it, too.");
  ImGui::SameLine(0, spacing);
  ImGui::SetNextItemWidth(width);
  int percent = static_cast<int>(std::lround(100 * brush.share));
  const Slid share = slider(ui, "brush_share", percent, 0, 100, [&] {
    return ImGui::SliderInt("##brush_share", &percent, 0, 100, "follows %d %%", flags);
  });
  if (share.moved || share.typed) brush.share = static_cast<float>(share.typed.value_or(percent) / 100);
  hint(
      "How much of its motion the model keeps where it is painted: 0 % stays at rest. With Ctrl the brush "
      "paints 100 %.");
}

}  // namespace

void transform_fields(const Context& ui) {
  const auto& w = ui.workspace;
  const auto kind = static_cast<std::size_t>(w.document.selection.kind());
  if (w.document.has_cage())
    command_choice(ui, {"select_vertices", "select_edges", "select_faces", "select_probes"}, kind);
  if (w.tool == scene::Tool::paint) return brush_fields(ui);
  const Fields shown = fields(w);
  note(ui, shown.label);
  ImGui::BeginDisabled(w.document.selection.empty() || w.interaction.drag);
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
