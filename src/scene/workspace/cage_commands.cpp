// Commands for the cage and the deformer.
#include <cmath>
#include <string>
#include <type_traits>

#include "base/error.h"
#include "base/text.h"
#include "scene/document/cage_editing.h"
#include "scene/document/edit.h"
#include "scene/document/elements.h"
#include "scene/document/selection_sets.h"
#include "scene/workspace/check_view.h"
#include "scene/workspace/choice_commands.h"
#include "scene/workspace/command_conditions.h"
#include "scene/workspace/command_tables.h"

namespace viete::scene {

namespace {

void make_symmetric_cage(Workspace& w) {
  constexpr CageSymmetry symmetries[] = {CageSymmetry::automatic, CageSymmetry::x, CageSymmetry::y,
                                         CageSymmetry::z, CageSymmetry::automatic};
  w.making = {.open = true, .wish = w.making.wish, .before = w.document.cage};
  w.making.wish.symmetry = symmetries[static_cast<std::size_t>(w.handling.mirror)];
}

void switch_cage_editing(Document& document) {
  is_editing_cage(document) ? end_cage_editing(document) : begin_cage_editing(document);
}

constexpr Concern of_cage{.scope = Scope::cage};

void enclose_and_say(Workspace& w) {
  const std::size_t left = enclose_model(w.document);
  if (left == 0) return w.messages.info("All vertices of the model are within the cage.", of_cage);
  w.messages.warn(counted(ElementKind::vertex, left) +
                      " of the model still outside of the cage; move it there, or make one",
                  of_cage);
}

void fit_turned_and_say(Workspace& w) {
  const double degrees = fit_cage_turned(w.document);
  if (degrees > 0)
    return w.messages.info("The cage was turned by " +
                               base::with_thousands(static_cast<std::size_t>(std::lround(degrees))) +
                               " degrees.",
                           of_cage);
  w.messages.info("The cage was fitted as it stands: no turn brings it clearly nearer to the model.",
                  of_cage);
}

void snap_and_say(Workspace& w) {
  const auto [moved, left] = snap_selected(w.document);
  if (left > 0)
    return w.messages.warn("No short way leads out of the model from " + counted(ElementKind::vertex, left) +
                               " of the cage; move by hand what is within",
                           of_cage);
  w.messages.info(moved == 0 ? "What is selected is outside of the model."
                             : counted(ElementKind::vertex, moved) + " of the cage moved out of the model.",
                  of_cage);
}

// Shows an error if the result would be no valid cage, without a change. `Change` takes the document, or the
// workspace and a label.
template <auto Change>
void change_cage(Workspace& w) {
  const CageGroups groups = w.document.groups;
  try {
    if constexpr (std::is_invocable_v<decltype(Change), Document&>) {
      Change(w.document);
    } else {
      Change(w);
    }
    w.messages.succeeded("change the cage");
  } catch (const base::Error& error) {
    w.messages.error(error.what(), {"change the cage", Scope::cage});
  }
  if (const std::string lost = lost_sets(groups, w.document.groups); !lost.empty())
    w.messages.warn("Nothing is left of these sets: " + lost + "; undo brings them back",
                    {.scope = Scope::cage});
  w.interaction.hovered.reset();
}

}  // namespace

void add_cage_commands(CommandTable& table) {
  table.heading("Cage");
  table.add(
      "make_cage", "Make a cage", "Make a cage around the model; sliders say how.", can_make_cage,
      [](Workspace& w) { w.making = {.open = true, .wish = w.making.wish, .before = w.document.cage}; });
  table.add("make_symmetric_cage", "Make a symmetric cage",
            "Make a cage around the model whose vertices all have their image in the mirror; Cancel brings "
            "the old one back.",
            lacks_pairs, make_symmetric_cage);
  table.add("finish_cage", {"Keep the made cage", "Done"},
            "Keep this cage; a preview is made with all care first.", can_change_wish,
            passing([](Workspace& w) { w.making.closing = true; }));
  table.add("cancel_cage", {"Take the made cage back", "Cancel"}, "Take the cage back that was made here.",
            is_making, passing([](Workspace& w) {
              cancel_making(w.document, w.making);
              w.interaction.hovered.reset();
            }));
  table.add("hide_cage_offer", {"Hide the offer about the cage", "Not now"},
            "Go on without it; the panels Cage and Checks still offer it.", has_model,
            passing([](Workspace& w) {
              w.offer_cage = false;
              if (has_outside(w)) dismiss_badge(w.checks);
            }));
  table.add("edit_cage", "Edit cage",
            "Change the cage itself, which is shown at rest; the pose is carried along.", {Key::tab},
            can_edit_cage, {change_cage<switch_cage_editing>, [](const Workspace& w) {
                              return w.document.kept_pose.has_value();
                            }});
  table.add("split_edges", {"Split edges", "Split"}, "A new vertex in the middle of each selected edge.",
            has_cage_selected, change_cage<split_selected>);
  table.add("cut_faces", {"Cut faces", "Cut"}, "A new vertex in the middle of each selected face.",
            has_cage_selected, change_cage<cut_selected>);
  table.add("extrude_faces", {"Extrude faces", "Extrude"},
            "Push the selected faces out, with new faces around them.", has_cage_selected,
            change_cage<extrude_selected>);
  table.add("merge_vertices", {"Merge vertices", "Merge"}, "The selected vertices become one.",
            has_cage_selected, change_cage<merge_selected>);
  table.add("remove_elements", {"Remove from the cage", "Remove"},
            "Take vertices or edges out of the cage, which stays closed; or faces, which leave a hole.",
            {Key::delete_key}, has_cage_selected, change_cage<remove_selected>);
  table.add("subdivide_cage", {"Subdivide cage", "Subdivide"},
            "The same cage with about four times the faces.", can_edit_cage, change_cage<subdivide_cage>);
  table.add("mirror_cage", {"Mirror cage", "Mirror"},
            "The half with the selection, else the one of larger coordinates, and its image.", can_edit_cage,
            change_cage<mirror_cage>);
  table.add("fit_cage", {"Fit cage to the model", "Fit"}, "Move and scale the cage to the model.",
            can_edit_cage, change_cage<fit_cage>);
  table.add("fit_cage_turned", {"Fit cage to the model, turned", "Fit, turned"},
            "Turn, move and scale the cage to the model.", can_edit_cage, change_cage<fit_turned_and_say>);
  table.add("snap_outside", {"Snap cage out of the model", "Snap out"},
            "Bring selected vertices that are within the model, or touch it, out by the shortest way.",
            has_cage_selected, change_cage<snap_and_say>);
  table.add("show_outside", {"Show what is outside of the cage", "Show them"},
            "Highlight the vertices of the model that are outside, or hide them again; Checks steps through "
            "them.",
            has_outside, passing([](Workspace& w) { toggle_finding(w, *outside_finding(w.checks)); }));
  table.add("enclose_model", {"Enclose the model", "Enclose"},
            "Move the cage outward where vertices of the model are outside.", can_edit_cage,
            change_cage<enclose_and_say>);
}

namespace {

// A command for a deformer, or for one of its parts.
template <class Entry>
void add_table(CommandTable& table, std::span<const Entry> entries, std::string_view headline) {
  for (const Entry& entry : entries)
    table.choice(choice_command_name(entry.value), headline, entry.label, entry.sentence, no_drag_runs,
                 [value = entry.value](Workspace& w) {
                   set_scheme(w.document, deform::chosen(value, w.document.scheme));
                 });
}

void add_methods(CommandTable& table) {
  char digit = '1';
  for (const auto& entry : sym3::methods())
    table.add(std::string("method_") + entry.name, {std::string("Method: ") + entry.label, entry.label},
              entry.sentence, {key(digit++), false, true}, uses_method,
              [method = entry.method](Workspace& w) { w.document.put_method(method); });
}

}  // namespace

void add_blend_commands(CommandTable& table) {
  table.heading("Method");
  add_methods(table);
  table.heading("Blend");
  add_table(table, deform::all_ways(), "Deformer");
  add_table(table, deform::all_weights(), "Weights");
  add_table(table, deform::all_blends(), "Blend");
  table.add("toggle_stitched", {"Stitch the model (ARAP)", "Stitched (ARAP)"},
            "As rigid as possible: the triangles of the model follow the blended maps, and its vertices are "
            "solved for. Details keep their shape; a frame takes longer.",
            without_drag<has_maps>,
            {[](Workspace& w) { set_iterations(w.document, w.document.scheme.stitched() ? 0 : 1); },
             [](const Workspace& w) { return w.document.scheme.stitched(); }});
  table.heading("Method");
  table.add(
      "toggle_same_path", "Same engine for all (staged, double)",
      "Run Fast stage by stage in double precision, as the other methods. Otherwise its frame is one pass in "
      "single precision.",
      uses_method, switches(&ViewOptions::same_path));
  table.add("show_report", {"Make a report", "Make a report"},
            "Measure the figures of the paper on the dragon, which takes half a minute, and open them in the "
            "browser.",
            is_not_reporting, [](Workspace& w) { w.requests.show_report = true; });
  table.add("stop_report", {"Cancel the report", "Cancel"}, "Stop measuring.", is_reporting,
            passing([](Workspace& w) { w.requests.stop_report = true; }));
}

}  // namespace viete::scene
