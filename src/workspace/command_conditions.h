// The conditions of commands. Each condition has an advice that is shown if the condition is false.
#pragma once

#include "document/edit.h"
#include "document/elements.h"
#include "document/probes.h"
#include "workspace/command.h"
#include "workspace/workspace.h"

namespace viete::workspace {

// True during a drag of elements or keys, a mask stroke or a brush selection. Other edits must wait.
inline bool is_dragging(const Workspace& w) {
  const auto& time = w.view.time.drag;
  return w.view.interaction.drag || w.view.interaction.stroke || w.view.interaction.brushing ||
         (time && time->what == TimeView::What::keys);
}
inline bool selects_probes(const Workspace& w) {
  return w.document.selection().kind() == document::ElementKind::probe;
}
inline constexpr Condition no_drag_runs{[](const Workspace& w) { return !is_dragging(w); },
                                        "Finish the current drag first."};
template <const Condition& C>
inline constexpr Condition without_drag{[](const Workspace& w) { return C(w) && !is_dragging(w); },
                                        C.otherwise};

inline constexpr Condition always{[](const Workspace&) { return true; }, ""};
inline constexpr Condition uses_method{[](const Workspace& w) { return w.document.deformer().exponential(); },
                                       "This blend uses no exponential; choose \"Log space\" first."};
inline constexpr Condition has_maps{
    [](const Workspace& w) { return w.document.deformer().has_maps(); },
    "Not available for this deformer: it uses the vertices of the cage, not its faces."};
inline constexpr Condition has_model{[](const Workspace& w) { return w.document.model().surface != nullptr; },
                                     "Open a model first."};
inline constexpr Condition has_cage{[](const Workspace& w) { return w.document.has_cage(); },
                                    "Open a cage first."};
inline constexpr Condition is_movable{[](const Workspace& w) { return w.document.is_movable(); },
                                      "Open a cage, add a probe or import shapes first."};
inline constexpr Condition has_elements{
    [](const Workspace& w) { return element_count(w.document, w.document.selection().kind()) > 0; },
    "Nothing to select: open a cage or add a probe first."};
inline constexpr Condition has_probe_room{
    [](const Workspace& w) {
      return has_model(w) && w.document.probes().all.size() < document::most_probes && !is_dragging(w);
    },
    "Open a model first. At most 256 probes are possible."};
inline constexpr Condition has_pin_room{
    [](const Workspace& w) { return w.document.has_faces() && has_probe_room(w); },
    "Pins need a model with faces. At most 256 probes are possible."};
inline constexpr Condition has_probes_selected{[](const Workspace& w) {
                                                 return selects_probes(w) &&
                                                        !w.document.selection().empty() && !is_dragging(w);
                                               },
                                               "Select a probe first."};
inline constexpr Condition has_pins_selected{
    [](const Workspace& w) {
      return has_probes_selected(w) && std::ranges::any_of(w.document.selection().indices(), [&](auto i) {
               return w.document.probes().all[i].pin.has_value();
             });
    },
    "Select a pin first."};
inline constexpr Condition has_free_probes_selected{
    [](const Workspace& w) { return has_free_probes(w.document) && !is_dragging(w); },
    "Select an unlocked probe first."};
inline constexpr Condition has_mask{[](const Workspace& w) { return w.document.mask() != nullptr; },
                                    "Nothing is painted: the whole model follows the cage."};
inline constexpr Condition has_selection{[](const Workspace& w) { return !w.document.selection().empty(); },
                                         "Nothing is selected."};
inline constexpr Condition has_selection_or_hover{[](const Workspace& w) {
                                                    return has_cage(w) && !selects_probes(w) &&
                                                           (has_selection(w) || w.view.interaction.hovered);
                                                  },
                                                  "Select part of the cage first, or point at it."};
inline constexpr Condition selects_of_cage{
    [](const Workspace& w) { return has_cage(w) && !selects_probes(w); },
    "Open a cage and choose vertices, edges or faces first."};
inline constexpr Condition has_selection_of_cage{
    [](const Workspace& w) { return selects_of_cage(w) && has_selection(w); },
    "Select part of the cage first."};
inline constexpr Condition has_hidden{[](const Workspace& w) { return !w.document.groups().hidden.empty(); },
                                      "No part of the cage is hidden."};
inline constexpr Condition can_draw_selection{
    [](const Workspace& w) { return has_elements(w) && shows_selectable(w) && !is_dragging(w); },
    "Nothing to select: open a cage, show it (C) or add a probe first."};
inline constexpr Condition is_armed{[](const Workspace& w) { return w.view.interaction.armed.has_value(); },
                                    "Start box, lasso or brush selection first."};
inline constexpr Condition is_working{[](const Workspace& w) { return w.jobs.working(); },
                                      "No task is running."};
inline constexpr Condition can_make_cage{[](const Workspace& w) {
                                           return has_model(w) && !w.making.open && !w.jobs.loading.running &&
                                                  !is_dragging(w);
                                         },
                                         "Open a model first. If you are making a cage, choose Done."};
inline constexpr Condition lacks_pairs{
    [](const Workspace& w) { return can_make_cage(w) && mirror_of(w) && mirror_of(w)->unpaired() > 0; },
    "Choose a mirror in Transform first. All vertices of the cage may have a mirror image already."};
inline constexpr Condition can_edit_cage{
    [](const Workspace& w) { return has_cage(w) && !w.making.open && !is_dragging(w); },
    "Open or make a cage first. If you are making one, choose Done."};
inline constexpr Condition is_editing{
    [](const Workspace& w) { return is_editing_cage(w.document) && !is_dragging(w); },
    "Start cage editing first."};
inline constexpr Condition has_cage_selected{
    [](const Workspace& w) {
      return is_editing(w) && !selects_probes(w) && has_selection(w) &&
             !w.view.time.hovered;  // over the timeline, Delete deletes timeline keys
    },
    "Start cage editing and select part of the cage first."};
inline constexpr Condition has_outside{
    [](const Workspace& w) { return outside_finding(w.checks).has_value(); },
    "The cage encloses all vertices of the model."};
inline constexpr Condition is_making{[](const Workspace& w) { return w.making.open; },
                                     "Choose \"Make cage\" first."};
inline constexpr Condition is_wishing{
    [](const Workspace& w) { return w.making.open && !w.making.closing; },
    "Choose \"Make cage\" first. If the cage is confirmed already, wait until it is computed."};
inline constexpr Condition has_cage_beside{
    [](const Workspace& w) { return !w.document.cage_beside().empty() && !w.jobs.loading.running; },
    "The model's folder contains no cage for the model."};
inline constexpr Condition is_exporting{[](const Workspace& w) { return w.jobs.exporting.running; },
                                        "Nothing is being exported."};
inline constexpr Condition is_reporting{[](const Workspace& w) { return w.jobs.reporting.running; },
                                        "No report is being made."};
inline constexpr Condition is_not_reporting{[](const Workspace& w) { return !w.jobs.reporting.running; },
                                            "A report is being made; cancel it first."};
inline constexpr Condition has_recovery_files{
    [](const Workspace& w) { return !w.recovery.files.empty() && !w.jobs.loading.running; },
    "There are no recovered edits."};
inline constexpr Condition offers_recovery{
    [](const Workspace& w) { return has_recovery_files(w) && w.recovery.offered; },
    "No recovered edits are shown."};
inline constexpr Condition can_undo{
    [](const Workspace& w) { return w.document.history().can_undo() && !is_dragging(w); },
    "There is no edit to undo."};
inline constexpr Condition can_redo{
    [](const Workspace& w) { return w.document.history().can_redo() && !is_dragging(w); },
    "There is no edit to redo."};
inline constexpr Condition is_posed{
    [](const Workspace& w) { return !is_dragging(w) && differs_from_rest(w.document); },
    "Cage and probes are at rest."};
inline constexpr Condition has_posed_selection{[](const Workspace& w) {
                                                 return has_selection(w) && is_posed(w) &&
                                                        (selects_probes(w) || !is_editing_cage(w.document)) &&
                                                        !w.view.time.hovered;
                                               },
                                               "The selection is already at rest."};

/// An effect that asks the program to cancel running work.
template <CancelWork::Work work>
void cancel(Workspace& w) {
  w.jobs.wishes.add(CancelWork{work});
}

/// The effect of a command that toggles an option of the view.
inline Effect switches(bool document::ViewOptions::*option) {
  return {[=](Workspace& w) { w.view.options.*option = !(w.view.options.*option); },
          [=](const Workspace& w) { return w.view.options.*option; }};
}

}  // namespace viete::workspace
