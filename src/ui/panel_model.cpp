#include "ui/format.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

std::string surface_text(const mesh::Facts& facts) {
  const std::string kind = !facts.manifold() ? "not manifold" : facts.closed() ? "closed" : "open";
  return facts.parts > 1 ? kind + ", " + count(facts.parts) + " parts" : kind;
}

}  // namespace

void panel_model(const Context& ui) {
  const auto& model = ui.workspace.document.model;
  const bool open = section(ui, "Model");
  if (model.surface) section_note(ui, surface_text(model.facts));
  if (!open) return;
  if (!model.surface && ui.workspace.loading.running) return note(ui, ui.workspace.loading.what);
  if (!model.surface) {
    note(ui, "No model is open. Open one, or drop a file on the window.");
    command_button(ui, "open_model");
    recent_list(ui, 4);
    return;
  }
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(model.path.filename().string().c_str());
  ImGui::PopTextWrapPos();
  hint(model.path.string() + "  (" + model.format + ")");
  value_row(ui, "Vertices, triangles", count(model.facts.vertices) + "  " + count(model.facts.triangles));
  value_row(ui, "Diagonal", length(model.bounds.diagonal()));
  command_row(ui, {"open_model", "save_session", "save_model"});
}

}  // namespace viete::ui
