#include "ui/format.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

std::string surface_text(const scene::Summary& summary) {
  const std::string kind = !summary.manifold() ? "not manifold" : summary.closed() ? "watertight" : "open";
  return summary.parts > 1 ? kind + ", " + count(summary.parts) + " parts" : kind;
}

}  // namespace

void panel_model(const Context& ui) {
  const auto& model = ui.workspace.document.model;
  const bool open = section(ui, "Model");
  if (model.surface) section_note(ui, surface_text(model.summary));
  if (!open) return;
  if (!model.surface && ui.workspace.loading.running) return note(ui, ui.workspace.loading.what);
  if (!model.surface) {
    note(ui, "No model is open. Open one, or drop a file on the window.");
    command_button(ui, "open_model");
    if (const auto clicked = recent_list(ui, 4)) open_recent(ui.workspace, *clicked);
    return;
  }
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(model.path.filename().string().c_str());
  ImGui::PopTextWrapPos();
  hint(model.path.string() + "  (" + model.format + ")");
  value_row(ui, "Vertices, triangles", count(model.summary.vertices) + "  " + count(model.summary.triangles));
  command_row(ui, {"open_model", "save_model"});
}

}  // namespace viete::ui
