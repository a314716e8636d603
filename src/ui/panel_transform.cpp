#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "document/elements.h"
#include "interact/transform_drag.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/command_tables.h"
#include "workspace/pointer.h"

namespace viete::ui {

namespace {

// Shows one row per set. Changes are applied after all rows are drawn.
void sets(const Context& ui) {
  document::Document& document = ui.workspace.document;
  const auto& all = document.groups().sets;
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const float select_width = 64, close = ImGui::GetFrameHeight();
  const float width = ImGui::GetContentRegionAvail().x - select_width - close - 2 * gap;
  std::optional<std::size_t> selected, removed, renamed;
  std::string name;
  ImGui::BeginDisabled(workspace::is_dragging(ui.workspace));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string id = "set/" + std::to_string(i);
    if (const auto typed =
            name_field(ui, id, all[i].name, width, "Name of the selection set. Type to rename it.")) {
      renamed = i;
      name = *typed;
    }
    ImGui::SameLine(0, gap);
    if (button(ui, ("Select##" + id).c_str(), id + "/select", "Select this set. Shift adds, Ctrl removes.",
               {select_width, 0}))
      selected = i;
    ImGui::SameLine(0, gap);
    if (button(ui, ("x##" + id).c_str(), id + "/remove",
               "Delete this selection set. The cage is not changed.", {close, 0}))
      removed = i;
  }
  ImGui::EndDisabled();
  if (renamed) document::rename_set(document, *renamed, name);
  if (selected) document::select_set(document, *selected, select_mode());
  if (removed) document::remove_set(document, *removed);
  if (selected || removed) ui.workspace.view.interaction.hovered.reset();
}

}  // namespace

// The most common commands. The menu Select has all commands.
void panel_select(const Context& ui) {
  if (!ui.workspace.document.has_cage() || !section(ui, "Select", false)) return;
  command_row(ui, {"select_all", "select_none", "invert_selection"});
  command_row(ui, {"select_more", "select_less", "save_set"});
  const float half = ImGui::GetCursorPosX() + 0.5f * ImGui::GetContentRegionAvail().x;
  command_toggle(ui, "toggle_select_visible");
  if (!ui.workspace.document.groups().hidden.empty()) {
    ImGui::SameLine(half);
    command_button(ui, "show_hidden", -1);
  }
  sets(ui);
}

namespace {

constexpr float transform_label = 56;

void label_row(const Context& ui, const char* text) {
  ImGui::AlignTextToFramePadding();
  text_in(ui.colors.faint, text);
  ImGui::SameLine(transform_label + ImGui::GetStyle().WindowPadding.x);
}

// The width of the first of two lists in a row.
float share_of_rest(float share) {
  return share * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
}

void pivot_row(const Context& ui) {
  const document::Handling& handling = ui.workspace.view.handling;
  label_row(ui, "Pivot");
  choice_list(ui, "pivot", std::optional(handling.pivot), share_of_rest(0.54f));
  ImGui::SameLine();
  choice_list(ui, "axes", std::optional(handling.axes), -1);
}

std::string pairs_text(const document::MirrorCache& known) {
  if (!known.mirror) return "";
  const std::size_t without = known.mirror->unpaired();
  return without == 0 ? "all paired" : count(without) + " unpaired";
}

void mirror_row(const Context& ui) {
  workspace::Workspace& w = ui.workspace;
  label_row(ui, "Mirror");
  const float width = share_of_rest(0.5f);
  choice_list(ui, "mirror", std::optional(w.view.handling.mirror), width);
  ImGui::SameLine();
  const float right = ImGui::GetCursorScreenPos().x + width;
  const bool lacks = w.view.mirror.mirror && w.view.mirror.mirror->unpaired() > 0;
  text_right(ui, right, pairs_text(w.view.mirror), lacks ? ui.colors.warn : ui.colors.faint,
             ImGui::GetCursorScreenPos().y + ImGui::GetStyle().FramePadding.y);
  ImGui::NewLine();
  if (lacks) command_row(ui, {"make_symmetric_cage"});
}

void soft_radius(const Context& ui) {
  document::SoftSelection& soft = ui.workspace.view.handling.soft;
  const double diagonal = ui.workspace.document.space().diagonal();
  const double least = soft.least_radius, most = soft.largest_radius;
  const auto chosen = slider(ui, "soft_radius", soft.radius * diagonal,
                             {.least = least * diagonal,
                              .most = most * diagonal,
                              .format = "%.3g",
                              .tip = "Radius of soft selection. The wheel changes it during a drag.",
                              .logarithmic = true,
                              .enabled = soft.on});
  if (chosen) soft.radius = std::clamp(*chosen / diagonal, least, most);
}

void soft_rows(const Context& ui) {
  const document::SoftSelection& soft = ui.workspace.view.handling.soft;
  const float left = ImGui::GetCursorPosX(), column = left + transform_label;
  command_toggle(ui, "toggle_soft", soft.on);
  ImGui::BeginDisabled(!soft.on);
  ImGui::SetCursorPosX(column);
  soft_radius(ui);
  ImGui::SetCursorPosX(column);
  choice_list(ui, "soft_curve", std::optional(soft.curve), share_of_rest(0.43f));
  ImGui::SameLine();
  choice_list(ui, "soft_distance", std::optional(soft.distance), -1);
  ImGui::EndDisabled();
}

std::string transform_text(const workspace::Workspace& w) {
  std::string text(document::entry_of(w.view.handling.pivot).label);
  if (workspace::mirror_of(w)) text += ", mirrored";
  if (w.view.handling.soft.on) text += ", soft selection";
  return text;
}

}  // namespace

void panel_transform(const Context& ui) {
  if (!ui.workspace.document.is_movable()) return;
  const bool open = section(ui, "Transform", false);
  section_note(ui, transform_text(ui.workspace));
  if (!open) return;
  const document::Selection& selection = ui.workspace.document.selection();
  value_row(ui, "Selected",
            count(selection.size()) + " of " +
                count(document::element_count(ui.workspace.document, selection.kind())));
  transform_fields(ui);
  pivot_row(ui);
  if (!ui.workspace.document.has_cage()) return;
  mirror_row(ui);
  soft_rows(ui);
  command_row(ui, {"bend", "twist", "taper"});
  command_row(ui, {"smooth", "relax"});
}

namespace {

struct Fields {
  const char* label;
  const char* hint;
  glm::dvec3 values;
};

// The coordinates of `place` along the axes.
glm::dvec3 along(const glm::dmat3& axes, const glm::dvec3& place) {
  return glm::transpose(axes) * place;
}

Fields fields(const workspace::Workspace& w) {
  const interact::Tool tool = w.view.tool;
  if (tool == interact::Tool::rotate)
    return {"Rotate by (degrees)", "Rotate about this axis. Type an angle and press Enter.", {0, 0, 0}};
  if (tool == interact::Tool::scale)
    return {"Scale by", "Scale along this axis. Type a factor and press Enter.", {1, 1, 1}};
  glm::dvec3 place(0);
  if (!w.document.selection().empty()) {
    const interact::Anchor anchor = workspace::grip_of(w).anchor;
    place = along(anchor.axes, anchor.center);
  }
  return {w.view.handling.pivot == document::Pivot::median ? "Centre" : "Pivot",
          "Position of the selection along the chosen axes. Type a coordinate and press Enter.", place};
}

void apply(workspace::Workspace& workspace, int axis, double value) {
  document::Document& document = workspace.document;
  interact::Tool tool = workspace.view.tool;
  interact::Transform transform;
  const interact::Grip grip = workspace::grip_of(workspace);
  transform.pivot = grip.anchor.center;
  transform.axes = grip.anchor.axes;
  if (tool == interact::Tool::rotate) {
    transform.axis = grip.anchor.axes[axis];
    transform.degrees = std::clamp(value, -interact::most_degrees, interact::most_degrees);
    if (transform.degrees != value)
      workspace.messages.info("Rotated by " + count(static_cast<std::size_t>(interact::most_degrees)) +
                              " degrees, the maximum for one step");
  } else if (tool == interact::Tool::scale) {
    transform.factors[axis] = value;
  } else {
    const double offset = value - along(grip.anchor.axes, grip.anchor.center)[axis];
    transform.shift = offset * grip.anchor.axes[axis];
    tool = interact::Tool::move;
  }
  if (interact::transform_selection(document, tool, grip, transform)) return;
  workspace.messages.warn(tool == interact::Tool::rotate
                              ? "The cage cannot rotate any further; nothing was changed"
                              : "This position is too far from the model; nothing was moved");
}

void field(const Context& ui, const Fields& fields, int axis, float width) {
  const std::string name = std::string("transform_") + static_cast<char>('x' + axis);
  const bool enabled = !ui.workspace.document.selection().empty();
  const auto number = number_field(ui, name, fields.values[axis], width, fields.hint, enabled);
  if (number && enabled) apply(ui.workspace, axis, *number);
}

// The fields of the brush have the same height as the fields of other tools.
void brush_fields(const Context& ui) {
  document::Brush& brush = ui.workspace.view.brush;
  command_row(ui, {"mask_clear", "mask_invert"});
  const float spacing = ImGui::GetStyle().ItemSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - spacing) / 2;
  if (const auto radius = slider(ui, "brush_radius", brush.radius,
                                 {.least = document::Brush::least_radius,
                                  .most = 150,
                                  .format = "%.0f px",
                                  .tip = "Radius of the brush in pixels. Shift and the wheel change it too."},
                                 width))
    brush.radius = static_cast<float>(*radius);
  ImGui::SameLine(0, spacing);
  if (const auto percent = slider(ui, "brush_share", 100 * brush.share,
                                  {.least = 0,
                                   .most = 100,
                                   .format = "follows %.0f %%",
                                   .tip = "How far painted vertices follow the motion: at 0 % they stay at "
                                          "rest. Ctrl paints 100 %.",
                                   .rounded = std::round},
                                  width))
    brush.share = static_cast<float>(*percent / 100);
}

}  // namespace

void transform_fields(const Context& ui) {
  const auto& w = ui.workspace;
  const auto kind = static_cast<std::size_t>(w.document.selection().kind());
  if (w.document.has_cage())
    command_choice(ui, {"select_vertices", "select_edges", "select_faces", "select_probes"}, kind);
  if (w.view.tool == interact::Tool::paint) return brush_fields(ui);
  const Fields shown = fields(w);
  note(ui, shown.label);
  ImGui::BeginDisabled(w.document.selection().empty() || w.view.interaction.drag);
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
