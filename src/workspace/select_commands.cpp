#include "workspace/command_tables.h"

#include <array>
#include <utility>

#include "document/edit.h"
#include "document/elements.h"
#include "workspace/pointer.h"

namespace viete::workspace {

namespace {

// Undo and redo can change the kind of the elements, so the hovered element is reset.
template <void (*Step)(document::Document&)>
void take_step(Workspace& w) {
  Step(w.document);
  w.messages.hide_messages();
  w.view.interaction.hovered.reset();
}

std::size_t selectable(const Workspace& w) {
  return element_count(w.document, w.document.selection().kind());
}

void select_everything(Workspace& w) {
  document::Selection all(w.document.selection().kind());
  all.select_all(selectable(w));
  set_selection(w.document, std::move(all));
}

void invert_selection(Workspace& w) {
  document::Selection inverted = w.document.selection();
  inverted.invert(selectable(w));
  set_selection(w.document, std::move(inverted));
}

document::Selection selection_or_hovered(const Workspace& w) {
  document::Selection selection = w.document.selection();
  if (w.view.interaction.hovered && *w.view.interaction.hovered < selectable(w))
    selection.apply(std::array{*w.view.interaction.hovered}, document::SelectMode::add);
  return selection;
}

void select_linked(Workspace& w) {
  set_selection(w.document, linked(*w.document.cage(), selection_or_hovered(w)));
}

template <document::Selection (*Change)(const pose::Cage&, const document::Selection&)>
void change_selection(Workspace& w) {
  set_selection(w.document, Change(*w.document.cage(), w.document.selection()));
}

template <void (*Change)(document::Document&)>
void change_groups(Workspace& w) {
  Change(w.document);
  w.view.interaction.hovered.reset();
}

Effect arms(interact::SelectShape shape) {
  const auto toggle = [shape](Workspace& w) {
    arm(w, shape);
    w.view.interaction.handle.reset();
    w.view.interaction.hovered.reset();
  };
  return {toggle, [shape](const Workspace& w) { return w.view.interaction.armed == shape; }};
}

template <document::ElementKind Kind>
void select_by(Workspace& w) {
  select_kind(w.document, Kind);
  w.view.interaction.hovered.reset();
}

void add_edit_commands(CommandTable& table) {
  table.heading("Edit");
  table.add("undo", "Undo", "Undo the last edit.", {key('Z'), true}, can_undo, take_step<document::undo>)
      .of([](const Workspace& w) { return w.document.history().undo_label(); });
  table
      .add("redo", "Redo", "Redo the last undone edit.", {key('Z'), true, true}, can_redo,
           take_step<document::redo>)
      .or_by({key('Y'), true})
      .of([](const Workspace& w) { return w.document.history().redo_label(); });
  table.add("reset_pose", "Reset pose", "Return the whole cage and all probes to rest.", {key('R'), true},
            is_posed, [](Workspace& w) { reset_pose(w.document); });
  table.add("reset_selected", "Reset selected", "Return the selection to rest.", {Key::delete_key},
            has_posed_selection, [](Workspace& w) { reset_selected(w.document, mirror_of(w)); });
  table.add("preferences", "Preferences",
            "Set the interface scale, keymap and autosave, and restore recovered edits.", always,
            [](Workspace& w) { w.panels.show_preferences = true; });
}

}  // namespace

void add_select_commands(CommandTable& table) {
  add_edit_commands(table);
  table.heading("Select");
  table.add("select_vertices", {"Select vertices", "Vertices"}, "Select vertices of the cage by clicking.",
            {key('1')}, no_drag_runs, select_by<document::ElementKind::vertex>);
  table.add("select_edges", {"Select edges", "Edges"}, "Select edges of the cage by clicking.", {key('2')},
            no_drag_runs, select_by<document::ElementKind::edge>);
  table.add("select_faces", {"Select faces", "Faces"}, "Select faces of the cage by clicking.", {key('3')},
            no_drag_runs, select_by<document::ElementKind::face>);
  table.add("select_probes", {"Select probes", "Probes"}, "Select probes by clicking.", {key('4')},
            no_drag_runs, select_by<document::ElementKind::probe>);
  table
      .add("select_all", {"Select all", "All"}, "Select the whole cage or all probes.", {key('A')},
           without_drag<has_elements>, select_everything)
      .or_by({key('A'), true});
  table.add("select_none", {"Deselect all", "None"}, "Clear the selection.", {key('A'), false, true},
            without_drag<has_selection>, [](Workspace& w) {
              set_selection(w.document, document::Selection(w.document.selection().kind()));
            });
  table.add("invert_selection", {"Invert selection", "Invert"}, "Exchange selected and unselected elements.",
            {key('I'), true}, without_drag<has_elements>, invert_selection);
  table
      .add("select_linked", {"Select linked", "Linked"},
           "Select everything connected to the selection or to the element under the pointer.", {key('L')},
           without_drag<has_selection_or_hover>, select_linked)
      .or_by({key('L'), true});
  table.add("select_box", {"Box select", "Box"},
            "Select with a box. The drag can start anywhere. Shift adds, Ctrl removes.", {key('B')},
            can_draw_selection, arms(interact::SelectShape::box));
  table.add("select_lasso", {"Lasso select", "Lasso"},
            "Select by drawing a line around elements. Shift adds, Ctrl removes.", {key('B'), false, true},
            can_draw_selection, arms(interact::SelectShape::lasso));
  table.add("select_brush", {"Brush select", "Brush"},
            "Select by painting with a circle. The wheel changes its size, Ctrl removes, Esc ends.",
            {key('C'), false, true}, can_draw_selection, arms(interact::SelectShape::brush));
  table
      .add("stop_selecting", {"Stop selecting", "Done"}, "Stop selecting with box, lasso or brush.",
           {Key::escape}, is_armed, passing(disarm))
      .or_by({Key::enter});
  table.add("select_more", {"Grow selection", "Grow"}, "Grow the selection by one ring.", {Key::up, true},
            without_drag<has_selection_of_cage>, change_selection<document::grown>);
  table.add("select_less", {"Shrink selection", "Shrink"}, "Shrink the selection by one ring.",
            {Key::down, true}, without_drag<has_selection_of_cage>, change_selection<document::shrunk>);
  table.add("hide_selected", {"Hide selected", "Hide"},
            "Hide the selection. Hidden elements stay unchanged until shown again.", {key('H'), false, true},
            without_drag<has_selection_of_cage>, change_groups<document::hide_selected>);
  table.add("hide_others", "Hide unselected", "Hide all unselected elements of the cage.",
            {key('H'), true, true}, without_drag<has_selection_of_cage>,
            change_groups<document::hide_others>);
  table.add("show_hidden", {"Show hidden", "Show hidden"}, "Show all hidden elements of the cage again.",
            {key('H'), true}, without_drag<has_hidden>, change_groups<document::show_all>);
  table.add("save_set", {"Save selection set", "Save set"},
            "Save the selection as a named set to select again later.", without_drag<has_selection_of_cage>,
            change_groups<document::save_set>);
  table.add("toggle_select_visible", {"Select visible only", "Visible only"},
            "Select only elements that are not behind the model or the cage.", {key('Z')}, always,
            switches(&document::ViewOptions::select_visible));
}

}  // namespace viete::workspace
