#include <cctype>

#include "document/elements.h"
#include "interact/gizmo.h"
#include "ui/format.h"
#include "ui/help_overlay.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

std::string hovered_text(const document::Selection& selection, std::uint32_t element, bool crowded) {
  std::string name = document::element_name(selection.kind()) + ' ' + std::to_string(element);
  name[0] = static_cast<char>(name[0] - 'a' + 'A');
  const bool first_click =
      (crowded || selection.kind() == document::ElementKind::face) && !selection.contains(element);
  return name + (first_click ? ":  click selects, drag draws a box" : ":  click selects, drag moves");
}

std::string bend_words(const interact::Constraint& about) {
  if (about.kind == interact::Constraint::Kind::free) return "X Y Z choose the bend axis,  ";
  const std::string axis(1, static_cast<char>('X' + about.axis));
  return "bends about " + axis + " (press " + axis + " again for the view axis),  ";
}

std::string shape_words(const interact::TransformDrag& drag) {
  const interact::Shaping& shaping = drag.grip().shaping;
  const std::string about = shaping.shape == interact::Shape::bend ? bend_words(drag.constraint()) : "";
  return "Type digits or move sideways to set the amount,  " + about +
         "click confirms,  Esc cancels,  Shift slows,  Ctrl snaps";
}

// True if a drag would rotate a whole posed cage. This can change the model's shape: see manual, blending.
bool rotates_posed_cage(const workspace::Workspace& w) {
  const document::Document& d = w.document;
  return w.view.tool == interact::Tool::rotate && d.has_cage() &&
         d.selection().kind() != document::ElementKind::probe && d.deformer().exponential() &&
         d.pose().positions != d.cage()->surface.positions &&
         document::selected_vertices(*d.cage(), d.selection()).size() == d.pose().positions.size();
}

// Removes phrases from the end until the text fits. Two spaces separate the phrases.
std::string fitting(std::string text, float width) {
  while (!text.empty() && ImGui::CalcTextSize(text.c_str()).x > width) {
    const std::size_t end = text.rfind("  ");
    if (end == std::string::npos) return "";
    text.erase(text.find_last_not_of(" ,;:", end) + 1);
  }
  return text;
}

std::string numbers_text(const workspace::Workspace& w) {
  const auto median = w.view.split.views[0].stats.median();
  const std::string frame = median ? milliseconds(median->frame) + " a frame" : "";
  const std::string kernel = w.about.kernel.empty() ? "" : "kernel " + w.about.kernel;
  return frame + (frame.empty() || kernel.empty() ? "" : "   ") + kernel;
}

}  // namespace

std::string mouse_text(const workspace::Workspace& w) {
  const workspace::Keymap& keymap = w.preferences.keymap;
  if (w.view.interaction.drag && w.view.interaction.drag->grip().shaping.shape != interact::Shape::none)
    return shape_words(*w.view.interaction.drag);
  if (w.view.interaction.drag)
    return std::string("X Y Z limit to an axis,  digits set the amount,  ") +
           (w.view.handling.soft.on ? "wheel changes the radius,  " : "") +
           "Ctrl snaps,  Shift slows;  Esc or right button cancels";
  if (w.view.time.hovered)
    return "Drag the ruler to change the frame,  keys to move them,  elsewhere to select;  wheel zooms,  "
           "middle drag pans";
  if (w.view.interaction.grab) return "Move the pointer into the view to start;  Esc cancels";
  if (w.view.interaction.placing_pivot)
    return "Click a vertex, an edge or the model to place the pivot;  Esc cancels";
  if (const std::string selecting = select_hint(w); !selecting.empty()) return selecting;
  if (!w.view.options.deformed)
    return "The model is shown at rest;  " + key_or_label(keymap, "toggle_deformed") +
           " shows the deformation";
  if (w.view.interaction.stroke) return "Release to confirm;  Esc or right button cancels";
  if (workspace::shows_mask(w))
    return "Drag paints vertices that stay at rest,  Ctrl erases;  Shift and wheel change the brush;  middle "
           "or right drag " +
           std::string(keymap.left_orbits() ? "orbits or pans" : "orbits");
  if (w.view.interaction.over_axes) return "Click to view along an axis, drag to orbit";
  if (w.view.interaction.handle && rotates_posed_cage(w))
    return interact::handle_name(w.view.tool, *w.view.interaction.handle) +
           ":  drag.  This changes the model's shape slightly.  To see another side, orbit the camera.";
  if (w.view.interaction.handle)
    return interact::handle_name(w.view.tool, *w.view.interaction.handle) +
           ":  drag;  Ctrl snaps,  Shift slows,  digits set the amount";
  if (w.view.interaction.hovered)
    return hovered_text(w.document.selection(), *w.view.interaction.hovered, w.view.interaction.crowded);
  if (w.document.selection().kind() == document::ElementKind::probe && !w.document.probes().empty())
    return "Drag a probe to move it,  " + empty_space_words(keymap);
  if (w.document.has_cage())
    return "Drag a vertex, edge or selected face to move it,  " + empty_space_words(keymap);
  std::string words = looking_words(keymap);
  words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
  return words;
}

void status_bar(const Context& ui) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const Window window("Status",
                      {.at = {0, display.y - status_height},
                       .pivot = {0, 0},
                       .size = {display.x, status_height},
                       .rounding = 0,
                       .padding = {12, 5}},
                      fixed_flags | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus);
  const std::string numbers = numbers_text(ui.workspace);
  ImGui::PushFont(ui.fonts.numbers);
  const float numbers_start = display.x - 36 - ImGui::CalcTextSize(numbers.c_str()).x;
  ImGui::PopFont();
  text_right(ui, display.x - 12, numbers, ui.colors.faint);
  text_in(ui.colors.faint, fitting(mouse_text(ui.workspace), numbers_start - ImGui::GetCursorPosX()));
  const float y = display.y - status_height;
  ImGui::GetWindowDrawList()->AddLine({0, y}, {display.x, y}, ui.colors.line);
}

}  // namespace viete::ui
