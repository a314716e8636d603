#include "scene/elements.h"
#include "ui/format.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

void panel_cage(const Context& ui) {
  const auto& document = ui.workspace.document;
  const bool open = section(ui, "Cage");
  if (document.has_cage()) section_note(ui, document.cage_file.summary.closed() ? "closed" : "open");
  if (!open) return;
  if (!document.has_cage()) {
    note(ui, "No cage is open. A cage is a coarse mesh around the model.");
    command_button(ui, "open_cage");
    return;
  }
  ImGui::TextUnformatted(document.cage_file.path.filename().string().c_str());
  hint(document.cage_file.path.string() + "  (" + document.cage_file.format + ")");
  const auto& summary = document.cage_file.summary;
  value_row(ui, "Vertices, triangles", count(summary.vertices) + "  " + count(summary.triangles));
  const auto elements = scene::element_count(document, document.selection.kind());
  value_row(ui, "Selected", count(document.selection.size()) + " of " + count(elements));
  transform_fields(ui);
  command_row(ui, {"undo", "redo", "reset_pose"});
  command_row(ui, {"select_all", "select_none", "invert_selection", "select_linked"});
  command_row(ui, {"open_cage", "open_pose", "save_pose"});
  for (const auto& line : ui.workspace.pose_notes) note(ui, line, ui.colors.warn);
}

}  // namespace viete::ui
