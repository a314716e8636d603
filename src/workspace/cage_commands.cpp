// Commands for the cage and the deformer.
#include <string>
#include <type_traits>

#include "base/error.h"
#include "base/text.h"
#include "document/cage_editing.h"
#include "document/edit.h"
#include "document/elements.h"
#include "workspace/command_tables.h"
#include "workspace/workspace.h"

namespace viete::workspace {

namespace {

void make_symmetric_cage(Workspace& w) {
  constexpr document::CageSymmetry symmetries[] = {
      document::CageSymmetry::automatic, document::CageSymmetry::x, document::CageSymmetry::y,
      document::CageSymmetry::z, document::CageSymmetry::automatic};
  w.making = {.open = true, .wish = w.making.wish, .before = w.document.cage()};
  w.making.wish.symmetry = symmetries[static_cast<std::size_t>(w.view.handling.mirror)];
}

void switch_cage_editing(document::Document& document) {
  is_editing_cage(document) ? end_cage_editing(document) : begin_cage_editing(document);
}

constexpr Condition has_suggestion{"The view shows no suggestion.",
                                   [](const Workspace& w) { return offers_next_step(w); }};

constexpr Concern of_cage{.scope = Scope::cage};

void enclose_and_say(Workspace& w) {
  const std::size_t left = enclose_model(w.document);
  if (left == 0) return w.messages.info("The cage encloses the model.", of_cage);
  w.messages.warn(counted(document::ElementKind::vertex, left) + " of the model " +
                      (left == 1 ? "is" : "are") +
                      " still outside the cage; move the cage outward there or make a new cage",
                  of_cage);
}

// Runs an edit of the cage. If the result would be an invalid cage, shows an error and changes nothing.
template <auto Change>
void change_cage(Workspace& w) {
  const document::CageGroups groups = w.document.groups();
  try {
    if constexpr (std::is_invocable_v<decltype(Change), document::Document&>) {
      Change(w.document);
    } else {
      Change(w);
    }
    w.messages.succeeded("change the cage");
  } catch (const base::Error& error) {
    w.messages.error(error.what(), {"change the cage", Scope::cage});
  }
  if (const std::string lost = lost_sets(groups, w.document.groups()); !lost.empty())
    w.messages.warn("These selection sets are now empty: " + lost + "; undo restores them",
                    {.scope = Scope::cage});
  w.view.interaction.hovered.reset();
}

template <class Value>
void choose_deformer(Workspace& w, Value value) {
  set_deformer(w.document, pose::chosen(value, w.document.deformer()));
}

void add_methods(CommandTable& table) {
  char digit = '1';
  for (const auto& entry : sym3::methods())
    table.add(std::string("method_") + entry.name, {std::string("Method: ") + entry.label, entry.label},
              entry.sentence, {key(digit++), false, true}, uses_method,
              [method = entry.method](Workspace& w) { w.document.put_method(method); });
}

}  // namespace

void add_cage_commands(CommandTable& table) {
  table.heading("Cage");
  table.add(
      "make_cage", "Make cage", "Make a cage around the model. Sliders set its size and fit.", can_make_cage,
      [](Workspace& w) { w.making = {.open = true, .wish = w.making.wish, .before = w.document.cage()}; });
  table.add("make_symmetric_cage", "Make symmetric cage",
            "Make a cage with mirror symmetry. Cancel restores the previous cage.", lacks_pairs,
            make_symmetric_cage);
  table.add("finish_cage", {"Accept new cage", "Done"},
            "Keep the new cage. If it is a preview, it is computed at full quality first.", is_wishing,
            passing([](Workspace& w) { w.making.closing = true; }));
  table.add("cancel_cage", {"Cancel new cage", "Cancel"},
            "Discard the new cage and restore the previous cage.", is_making, passing([](Workspace& w) {
              cancel_making(w.document, w.making);
              w.view.interaction.hovered.reset();
            }));
  table.add("hide_cage_offer", {"Dismiss cage suggestion", "Not now"},
            "Close this suggestion. The sections Cage and Checks have the same commands.", has_suggestion,
            passing([](Workspace& w) { w.panels.offer_cage = false; }));
  table.add("edit_cage", "Edit cage",
            "Edit the vertices and faces of the cage at rest. The pose follows the edits.", {Key::tab},
            can_edit_cage, {change_cage<switch_cage_editing>, [](const Workspace& w) {
                              return w.document.kept_pose().has_value();
                            }});
  table.add("split_edges", {"Split edges", "Split"}, "Insert a vertex at the middle of each selected edge.",
            has_cage_selected, change_cage<document::split_selected>);
  table.add("cut_faces", {"Cut faces", "Cut"}, "Insert a vertex at the middle of each selected face.",
            has_cage_selected, change_cage<document::cut_selected>);
  table.add("extrude_faces", {"Extrude faces", "Extrude"},
            "Move the selected faces outward and add faces around them.", has_cage_selected,
            change_cage<document::extrude_selected>);
  table.add("merge_vertices", {"Merge vertices", "Merge"}, "Merge the selected vertices into one.",
            has_cage_selected, change_cage<document::merge_selected>);
  table.add("remove_elements", {"Remove from cage", "Remove"},
            "Remove the selected elements. The cage stays closed after removing vertices or edges; removing "
            "faces leaves a hole.",
            {Key::delete_key}, has_cage_selected, change_cage<document::remove_selected>);
  table.add("subdivide_cage", {"Subdivide cage", "Subdivide"},
            "Divide each face of the cage into about four smaller faces.", can_edit_cage,
            change_cage<document::subdivide_cage>);
  table.add("mirror_cage", {"Mirror cage", "Mirror"},
            "Make the cage symmetric: the half with the selection is kept and mirrored. Without a "
            "selection, the half with larger coordinates is kept.",
            can_edit_cage, change_cage<document::mirror_cage>);
  table.add("fit_cage", {"Fit cage to model", "Fit"}, "Move and scale the cage to fit the model.",
            can_edit_cage, change_cage<document::fit_cage>);
  table.add("show_outside", {"Show vertices outside the cage", "Show"},
            "Highlight the vertices of the model that are outside the cage.", has_outside,
            passing([](Workspace& w) { toggle_finding(w, *outside_finding(w.checks)); }));
  table.add("enclose_model", {"Enclose model", "Enclose"},
            "Move the cage outward where vertices of the model are outside.", can_edit_cage,
            change_cage<enclose_and_say>);
}

void add_blend_commands(CommandTable& table) {
  table.heading("Method");
  add_methods(table);
  table.heading("Blend");
  add_choices<pose::Preset>(table, "Deformer", no_drag_runs, choose_deformer);
  add_choices<pose::Weights>(table, "Weights", no_drag_runs, choose_deformer);
  add_choices<pose::Blend>(table, "Blend", no_drag_runs, choose_deformer);
  table.add(
      "toggle_arap", {"As rigid as possible (ARAP)", "ARAP"},
      "Solve for the whole mesh so that its triangles deform as rigidly as possible. Preserves details, "
      "but frames take longer.",
      without_drag<has_maps>,
      {[](Workspace& w) { set_iterations(w.document, w.document.deformer().stitched() ? 0 : 1); },
       [](const Workspace& w) { return w.document.deformer().stitched(); }});
  table.heading("Method");
  table.add("show_report", {"Make report", "Make report"},
            "Repeat the measurements of the paper on the dragon and open the report in the browser. Takes "
            "about half a minute.",
            is_not_reporting, [](Workspace& w) { w.jobs.wishes.add(ShowReport{}); });
  table.add("stop_report", {"Cancel report", "Cancel"}, "Cancel the measurement. No report is written.",
            is_reporting, passing(cancel<CancelWork::Work::report>));
}

}  // namespace viete::workspace
