#include <optional>

#include "ui/choice_list.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

// What the colours span, to be typed while it is held.
void range_fields(const Context& ui) {
  scene::FieldView& shown = ui.workspace.field;
  if (!shown.holds_range || !shown.values) return;
  double low = shown.stats.low, high = shown.stats.high;
  const float width = 0.5f * (ImGui::GetContentRegionAvail().x - 2 * ImGui::CalcTextSize("to").x);
  ImGui::SetNextItemWidth(width);
  const auto typed_low = number_field(ui, "map/low", low);
  record(ui, "map/low");
  hint("The value at the first colour.");
  ImGui::SameLine();
  ImGui::TextUnformatted("to");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(width);
  const auto typed_high = number_field(ui, "map/high", high);
  record(ui, "map/high");
  hint("The value at the last colour.");
  low = typed_low.value_or(low), high = typed_high.value_or(high);
  if (!typed_low && !typed_high) return;
  if (!(low < high)) return ui.workspace.messages.warn("The first value of a range is below the last one.");
  shown.stats.low = static_cast<decltype(shown.stats.low)>(low);
  shown.stats.high = static_cast<decltype(shown.stats.high)>(high);
  lab::fit_counts(*shown.values, shown.stats);
}

}  // namespace

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
  range_fields(ui);
  command_button(ui, "frame_worst", ImGui::GetContentRegionAvail().x);
}

}  // namespace viete::ui
