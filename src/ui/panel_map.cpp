#include <optional>

#include "ui/choice_list.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

void panel_map(const Context& ui) {
  const scene::Workspace& w = ui.workspace;
  if (!w.document.model.surface) return;
  const lab::Field wanted = w.view.field;
  const bool open = section(ui, "Map", false);
  section_note(ui, wanted == lab::Field::none ? "" : std::string(base::entry_of(wanted).label));
  if (!open) return;
  choice_list(ui, "map", std::optional(wanted), ImGui::GetContentRegionAvail().x);
  if (wanted == lab::Field::none) return note(ui, "Colours the mesh by what the deformation does to it.");
  if (scene::shown_field(w) == lab::Field::none)
    return note(ui, "There is none here: it needs a cage, and a blend in log space.");
  const bool needs_selection = wanted == lab::Field::influence && w.document.selection.empty();
  note_within(ui, 2, needs_selection ? "Select something." : std::string(base::entry_of(wanted).hint));
  command_toggle(ui, "hold_map_range");
  command_button(ui, "frame_worst", ImGui::GetContentRegionAvail().x);
}

}  // namespace viete::ui
