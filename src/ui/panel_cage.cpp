#include "ui/format.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

void editing(const Context& ui) {
  if (!ui.workspace.document.kept_pose) return;
  command_row(ui, {"split_edges", "cut_faces", "extrude_faces"});
  command_row(ui, {"merge_vertices", "remove_elements", "subdivide_cage"});
  command_row(ui, {"mirror_cage", "snap_outside", "enclose_model"});
  command_row(ui, {"fit_cage", "fit_cage_turned"});
}

}  // namespace

void panel_cage(const Context& ui) {
  const auto& document = ui.workspace.document;
  const bool open = section(ui, "Cage");
  if (document.has_cage()) section_note(ui, document.cage_file.summary.closed() ? "watertight" : "open");
  if (!open) return;
  const bool wishing = ui.workspace.making.open && !ui.workspace.making.closing;
  if (wishing) panel_making(ui);
  if (!document.has_cage()) {
    if (wishing) return;
    note(ui, "No cage is open. A cage is a coarse mesh around the model.");
    command_row(ui, {"open_cage", "make_cage"});
    return;
  }
  ImGui::TextUnformatted(name_of(document.cage_file).c_str());
  hint(place_of(document.cage_file) + "  (" + document.cage_file.format + ")");
  const auto& summary = document.cage_file.summary;
  value_row(ui, "Vertices, triangles", count(summary.vertices) + "  " + count(summary.triangles));
  command_row(ui, {"open_cage", "make_cage", "edit_cage"});
  editing(ui);
}

}  // namespace viete::ui
