// The tables of commands, one per topic, and the conditions under which commands can run.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "document/edit.h"
#include "document/elements.h"
#include "document/handling.h"
#include "document/probes.h"
#include "document/timeline.h"
#include "document/view_options.h"
#include "pose/deformer.h"
#include "workspace/command.h"
#include "workspace/keymap.h"
#include "workspace/workspace.h"

namespace viete::workspace {

/// The rows are in the order of the command reference.
class CommandTable {
public:
  /// Sets the heading of the rows that follow.
  void heading(std::string_view group) { group_ = group; }

  /// Adds a row. The reference is valid until the next row is added.
  Command& add(std::string name, Label label, std::string hint, const Condition& enabled, Effect effect) {
    return add(std::move(name), std::move(label), std::move(hint), Shortcut{}, enabled, std::move(effect));
  }
  Command& add(std::string name, Label label, std::string hint, Shortcut shortcut, const Condition& enabled,
               Effect effect) {
    return rows_.emplace_back(Command{std::move(effect), std::move(name), std::move(label.words),
                                      std::move(label.brief), std::move(hint), enabled, group_, shortcut});
  }
  /// Adds a command for one value of a choice, in a submenu. Outside the submenu, the label begins with the
  /// submenu's title.
  void choice(std::string name, std::string_view submenu, std::string_view label, std::string_view hint,
              const Condition& enabled, Effect effect) {
    const std::string brief(label);
    add(std::move(name), {std::string(submenu) + ": " + brief, brief}, std::string(hint), enabled,
        std::move(effect))
        .under(submenu);
  }

  const std::vector<Command>& rows() const { return rows_; }

private:
  std::string_view group_;
  std::vector<Command> rows_;
};

void add_file_commands(CommandTable& table);
void add_select_commands(CommandTable& table);  ///< selection and undo
void add_cage_commands(CommandTable& table);
void add_tool_commands(CommandTable& table);    ///< tools and probes, in transform_commands.cpp
void add_blend_commands(CommandTable& table);   ///< methods and deformers, in cage_commands.cpp
void add_camera_commands(CommandTable& table);  ///< in view_commands.cpp, as the four below
void add_view_commands(CommandTable& table);    ///< display options
void add_map_commands(CommandTable& table);
void add_split_commands(CommandTable& table);
void add_help_commands(CommandTable& table);
void add_transform_commands(CommandTable& table);
void add_time_commands(CommandTable& table);            ///< named poses and timeline
void add_animation_file_commands(CommandTable& table);  ///< in file_commands.cpp

/// The names of the commands that choose a value of this type begin with this prefix, for example "pivot_".
template <class Value>
constexpr const char* choice_prefix() {
  if constexpr (std::is_same_v<Value, pose::Preset>) return "deformer_";
  if constexpr (std::is_same_v<Value, pose::Weights>) return "weights_";
  if constexpr (std::is_same_v<Value, pose::Blend>) return "blend_";
  if constexpr (std::is_same_v<Value, document::Pivot>) return "pivot_";
  if constexpr (std::is_same_v<Value, document::Axes>) return "axes_";
  if constexpr (std::is_same_v<Value, document::MirrorPlane>) return "mirror_";
  if constexpr (std::is_same_v<Value, document::SoftCurve>) return "soft_";
  if constexpr (std::is_same_v<Value, document::SoftDistance>) return "soft_";
  if constexpr (std::is_same_v<Value, document::Repeat>) return "repeat_";
  if constexpr (std::is_same_v<Value, document::Easing>) return "easing_";
  if constexpr (std::is_same_v<Value, document::Shading>) return "shading_";
  if constexpr (std::is_same_v<Value, analysis::Field>) return "map_";
  if constexpr (std::is_same_v<Value, KeyPreset>) return "keys_";
}

/// The name of the command that chooses the value: "deformer_paper", "pivot_median".
template <class Value>
std::string choice_command_name(Value value) {
  std::string name = choice_prefix<Value>();
  name += base::entry_of(value).word;
  std::ranges::replace(name, '-', '_');
  return name;
}

/// Adds a command for each value. The command calls `choose` with the value.
template <class Value>
void add_choices(CommandTable& table, std::string_view headline, const Condition& enabled,
                 void (*choose)(Workspace&, Value)) {
  int number = 0;
  for (const base::Choice& entry : choices(Value{})) {
    const auto value = static_cast<Value>(number++);
    table.choice(choice_command_name(value), headline, entry.label, entry.hint, enabled,
                 [=](Workspace& w) { choose(w, value); });
  }
}

inline bool selects_probes(const Workspace& w) {
  return w.document.selection().kind() == document::ElementKind::probe;
}
inline constexpr Condition no_drag_runs{"Finish the current drag first.",
                                        [](const Workspace& w) { return !is_dragging(w); }};
template <const Condition& C>
inline constexpr Condition without_drag{C.otherwise,
                                        [](const Workspace& w) { return C(w) && !is_dragging(w); }};

inline constexpr Condition always{"", [](const Workspace&) { return true; }};
inline constexpr Condition uses_method{
    "This blend uses no exponential; choose \"Log space\" first.",
    [](const Workspace& w) { return w.document.deformer().exponential(); }};
inline constexpr Condition has_maps{
    "Not available for this deformer: it uses the vertices of the cage, not its faces.",
    [](const Workspace& w) { return w.document.deformer().has_maps(); }};
inline constexpr Condition has_model{
    "Open a model first.", [](const Workspace& w) { return w.document.model().surface != nullptr; }};
inline constexpr Condition has_cage{"Open a cage first.",
                                    [](const Workspace& w) { return w.document.has_cage(); }};
inline constexpr Condition is_movable{"Open a cage, add a probe or import shapes first.",
                                      [](const Workspace& w) { return w.document.is_movable(); }};
inline constexpr Condition has_elements{
    "Nothing to select: open a cage or add a probe first.",
    [](const Workspace& w) { return element_count(w.document, w.document.selection().kind()) > 0; }};
inline constexpr Condition has_probe_room{
    "Open a model first. At most 256 probes are possible.", [](const Workspace& w) {
      return has_model(w) && w.document.probes().all.size() < document::most_probes && !is_dragging(w);
    }};
inline constexpr Condition has_pin_room{
    "Pins need a model with faces. At most 256 probes are possible.",
    [](const Workspace& w) { return w.document.has_faces() && has_probe_room(w); }};
inline constexpr Condition has_probes_selected{"Select a probe first.", [](const Workspace& w) {
                                                 return selects_probes(w) &&
                                                        !w.document.selection().empty() && !is_dragging(w);
                                               }};
inline constexpr Condition has_pins_selected{
    "Select a pin first.", [](const Workspace& w) {
      return has_probes_selected(w) && std::ranges::any_of(w.document.selection().indices(), [&](auto i) {
               return w.document.probes().all[i].pin.has_value();
             });
    }};
inline constexpr Condition has_free_probes_selected{
    "Select an unlocked probe first.",
    [](const Workspace& w) { return has_free_probes(w.document) && !is_dragging(w); }};
inline constexpr Condition has_mask{"Nothing is painted: the whole model follows the cage.",
                                    [](const Workspace& w) { return w.document.mask() != nullptr; }};
inline constexpr Condition has_selection{"Nothing is selected.",
                                         [](const Workspace& w) { return !w.document.selection().empty(); }};
inline constexpr Condition has_selection_or_hover{
    "Select part of the cage first, or point at it.", [](const Workspace& w) {
      return has_cage(w) && !selects_probes(w) && (has_selection(w) || w.view.interaction.hovered);
    }};
inline constexpr Condition selects_of_cage{
    "Open a cage and choose vertices, edges or faces first.",
    [](const Workspace& w) { return has_cage(w) && !selects_probes(w); }};
inline constexpr Condition has_selection_of_cage{"Select part of the cage first.", [](const Workspace& w) {
                                                   return selects_of_cage(w) && has_selection(w);
                                                 }};
inline constexpr Condition has_hidden{"No part of the cage is hidden.",
                                      [](const Workspace& w) { return !w.document.groups().hidden.empty(); }};
inline constexpr Condition can_draw_selection{
    "Nothing to select: open a cage, show it (C) or add a probe first.",
    [](const Workspace& w) { return has_elements(w) && shows_selectable(w) && !is_dragging(w); }};
inline constexpr Condition is_armed{"Start box, lasso or brush selection first.",
                                    [](const Workspace& w) { return w.view.interaction.armed.has_value(); }};
inline constexpr Condition is_working{"No task is running.",
                                      [](const Workspace& w) { return w.jobs.working(); }};
inline constexpr Condition can_make_cage{
    "Open a model first. If you are making a cage, choose Done.", [](const Workspace& w) {
      return has_model(w) && !w.making.open && !w.jobs.loading.running && !is_dragging(w);
    }};
inline constexpr Condition lacks_pairs{
    "Choose a mirror in Transform first. All vertices of the cage may have a mirror image already.",
    [](const Workspace& w) { return can_make_cage(w) && mirror_of(w) && mirror_of(w)->unpaired() > 0; }};
inline constexpr Condition can_edit_cage{
    "Open or make a cage first. If you are making one, choose Done.",
    [](const Workspace& w) { return has_cage(w) && !w.making.open && !is_dragging(w); }};
inline constexpr Condition is_editing{"Start cage editing first.", [](const Workspace& w) {
                                        return is_editing_cage(w.document) && !is_dragging(w);
                                      }};
inline constexpr Condition has_cage_selected{
    "Start cage editing and select part of the cage first.", [](const Workspace& w) {
      return is_editing(w) && !selects_probes(w) && has_selection(w) &&
             !w.view.time.hovered;  // over the timeline, Delete deletes timeline keys
    }};
inline constexpr Condition has_outside{
    "The cage encloses all vertices of the model.",
    [](const Workspace& w) { return outside_finding(w.checks).has_value(); }};
inline constexpr Condition is_making{"Choose \"Make cage\" first.",
                                     [](const Workspace& w) { return w.making.open; }};
inline constexpr Condition is_wishing{
    "Choose \"Make cage\" first. If the cage is confirmed already, wait until it is computed.",
    [](const Workspace& w) { return w.making.open && !w.making.closing; }};
inline constexpr Condition has_cage_beside{
    "The model's folder contains no cage for the model.",
    [](const Workspace& w) { return !w.document.cage_beside().empty() && !w.jobs.loading.running; }};
inline constexpr Condition is_exporting{"Nothing is being exported.",
                                        [](const Workspace& w) { return w.jobs.exporting.running; }};
inline constexpr Condition is_reporting{"No report is being made.",
                                        [](const Workspace& w) { return w.jobs.reporting.running; }};
inline constexpr Condition is_not_reporting{"A report is being made; cancel it first.",
                                            [](const Workspace& w) { return !w.jobs.reporting.running; }};
inline constexpr Condition has_recovery_files{"There are no recovered edits.", [](const Workspace& w) {
                                                return !w.recovery.files.empty() && !w.jobs.loading.running;
                                              }};
inline constexpr Condition offers_recovery{"No recovered edits are shown.", [](const Workspace& w) {
                                             return has_recovery_files(w) && w.recovery.offered;
                                           }};
inline constexpr Condition can_undo{"There is no edit to undo.", [](const Workspace& w) {
                                      return w.document.history().can_undo() && !is_dragging(w);
                                    }};
inline constexpr Condition can_redo{"There is no edit to redo.", [](const Workspace& w) {
                                      return w.document.history().can_redo() && !is_dragging(w);
                                    }};
inline constexpr Condition is_posed{"Cage and probes are at rest.", [](const Workspace& w) {
                                      return !is_dragging(w) && differs_from_rest(w.document);
                                    }};
inline constexpr Condition has_posed_selection{"The selection is already at rest.", [](const Workspace& w) {
                                                 return has_selection(w) && is_posed(w) &&
                                                        (selects_probes(w) || !is_editing_cage(w.document)) &&
                                                        !w.view.time.hovered;
                                               }};

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
