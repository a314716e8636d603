#include "scene/workspace/commands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/quantity.h"
#include "scene/document/cage_editing.h"
#include "scene/document/edge_rings.h"
#include "scene/document/edit.h"
#include "scene/document/elements.h"
#include "scene/document/probes.h"
#include "scene/document/selecting.h"
#include "scene/document/selection_sets.h"
#include "scene/hand/mirror_edit.h"
#include "scene/workspace/animation_file_commands.h"
#include "scene/workspace/check_view.h"
#include "scene/workspace/command_conditions.h"
#include "scene/workspace/file_commands.h"
#include "scene/workspace/hand_commands.h"
#include "scene/workspace/pointer.h"
#include "scene/workspace/time_commands.h"

namespace viete::scene {

namespace {

template <bool deform::Weighting::*Setting>
void toggle_weighting(Workspace& w) {
  Scheme scheme = w.document.scheme;
  scheme.weighting.*Setting = !(scheme.weighting.*Setting);
  set_scheme(w.document, scheme);
}

template <bool ViewOptions::*Option>
void toggle(Workspace& w) {
  w.view.*Option = !(w.view.*Option);
}

// With the panels, where they are hidden.
template <Column Which>
void toggle_column_of(Workspace& w) {
  const bool hidden = !std::exchange(w.view.panels, true);
  if (!hidden || !(shown_columns(w.remembered.layout, w.viewport.window.x).of(Which) > 0))
    toggle_column(w.remembered.layout, Which, w.viewport.window.x);
}

template <Shading Choice>
Command shading_command(std::string_view name) {
  const ShadingChoice& choice = all_shadings()[static_cast<std::size_t>(Choice)];
  static const std::string label = "Shading: " + std::string(choice.label);
  return {name,        {label, choice.label},
          choice.hint, "View",
          {},          {},
          always,      [](Workspace& w) { w.view.shading = Choice; }};
}

template <LengthUnit Unit>
Command unit_command(std::string_view name) {
  static const std::string hint =
      "Lengths are said in " + std::string(entry(Unit).plural) + "; no number is scaled.";
  static const std::string label = "Unit of the file: " + std::string(entry(Unit).symbol);
  return {name,      {label, entry(Unit).symbol},
          hint,      "View",
          {},        {},
          has_model, [](Workspace& w) { w.document.model.unit = Unit; }};
}

void show_next_shading(Workspace& w) {
  w.view.shading =
      static_cast<Shading>((static_cast<std::size_t>(w.view.shading) + 1) % all_shadings().size());
}

template <sym3::Method Method>
void use_method(Workspace& w) {
  set_method(w.document, Method);
}

template <sym3::Method Method>
Command method_command(std::string_view name, char digit) {
  const sym3::MethodEntry& entry = sym3::methods()[static_cast<std::size_t>(Method)];
  static const std::string label = "Method: " + std::string(entry.label);
  return {name, {label, entry.label}, entry.sentence,    "Method", {key(digit), false, true},
          {},   uses_method,          use_method<Method>};
}

std::string command_name(const char* choice, const deform::ChoiceEntry& entry) {
  std::string name = choice + std::string(entry.name);
  std::ranges::replace(name, '-', '_');
  return name;
}

std::string_view headline(deform::Way) {
  return "Way: ";
}
std::string_view headline(deform::Elements) {
  return "Elements: ";
}
std::string_view headline(deform::Weights) {
  return "Weights: ";
}
std::string_view headline(deform::Blend) {
  return "Blend: ";
}

template <auto Value>
Command choice_command() {
  static const std::string name = choice_command_name(Value);
  const auto& entry = deform::entry(Value);
  static const std::string label = std::string(headline(Value)) + std::string(entry.label);
  return {name, {label, entry.label}, entry.sentence, "Blend", {}, {}, hand_is_free, [](Workspace& w) {
            set_scheme(w.document, deform::chosen(Value, w.document.scheme));
          }};
}

template <StandardView View>
void look(Workspace& w) {
  w.camera.look(View);
  frame_all(w, true);
}

std::size_t selectable(const Workspace& w) {
  return element_count(w.document, w.document.selection.kind());
}

void select_everything(Workspace& w) {
  Selection all(w.document.selection.kind());
  all.select_all(selectable(w));
  set_selection(w.document, std::move(all));
}
void select_nothing(Workspace& w) {
  set_selection(w.document, Selection(w.document.selection.kind()));
}
void invert_selection(Workspace& w) {
  Selection inverted = w.document.selection;
  inverted.invert(selectable(w));
  set_selection(w.document, std::move(inverted));
}

// What is selected and under the cursor.
Selection selection_at_hand(const Workspace& w) {
  Selection selection = w.document.selection;
  if (w.interaction.hovered && *w.interaction.hovered < selectable(w))
    selection.apply(std::array{*w.interaction.hovered}, SelectMode::add);
  return selection;
}

void select_linked(Workspace& w) {
  set_selection(w.document, linked(*w.document.cage, selection_at_hand(w)));
}

template <Selection (*Change)(const deform::Cage&, const Selection&)>
void change_selection(Workspace& w) {
  set_selection(w.document, Change(*w.document.cage, w.document.selection));
}

template <Selection (*Change)(const deform::Cage&, std::span<const mesh::Point>, const Selection&)>
void select_like(Workspace& w) {
  set_selection(w.document, Change(*w.document.cage, w.document.pose.positions, w.document.selection));
}

void select_loop(Workspace& w) {
  Selection loop = looped(*w.document.cage, w.document.selection);
  if (loop == w.document.selection)
    w.messages.info("No loop goes on from there: select an edge, or two neighbouring vertices or faces.");
  set_selection(w.document, std::move(loop));
}

void select_ring(Workspace& w) {
  Selection ring = ringed(*w.document.cage, w.document.selection);
  if (ring == w.document.selection)
    w.messages.info(
        "No ring goes on from there: select an edge, or two neighbouring vertices, of a quad or of two "
        "triangles that make one.");
  set_selection(w.document, std::move(ring));
}

template <int Axis, bool Positive>
void select_side(Workspace& w) {
  const double middle = w.document.model.bounds.center()[Axis];
  set_selection(w.document, on_side(*w.document.cage, w.document.selection.kind(), Axis, Positive, middle));
}

template <int Axis, bool Positive>
Command side_command(std::string_view name, std::string_view side) {
  static const std::string hint = std::string("Select what of the cage is at rest on the ") +
                                  (Positive ? "positive" : "negative") +
                                  " side of the model's middle along " + static_cast<char>('X' + Axis) + '.';
  static const std::string label = "Select side " + std::string(side);
  return {name,
          {label, side},
          hint,
          "Select",
          {},
          {},
          with_free_hand<selects_of_cage>,
          select_side<Axis, Positive>};
}

template <void (*Change)(Document&)>
void change_groups(Workspace& w) {
  Change(w.document);
  w.interaction.hovered.reset();
}

template <SelectShape Shape>
void arm_shape(Workspace& w) {
  arm(w, Shape);
  w.interaction.handle.reset();
  w.interaction.hovered.reset();
}

// What is under the cursor may be of another kind then.
void step_back(Workspace& w) {
  undo(w.document);
  w.interaction.hovered.reset();
}

void step_forth(Workspace& w) {
  redo(w.document);
  w.interaction.hovered.reset();
}

template <ElementKind Kind>
void select_by(Workspace& w) {
  select_kind(w.document, Kind);
  w.interaction.hovered.reset();
}

// On the model under the cursor or, where none is there or a button was pressed, in the middle of the view.
void add_probe_in_view(Workspace& w) {
  const glm::vec2 middle = w.viewport.origin + 0.5f * w.viewport.size;
  const auto on_model = [&](const glm::vec2& at) {
    return pick_model(w.document, w.posed, w.camera.ray(at, w.viewport));
  };
  auto at = w.interaction.cursor ? on_model(*w.interaction.cursor) : std::nullopt;
  if (!at) at = on_model(middle);
  add_probe(w.document, w.posed, at.value_or(w.document.space.to_file(glm::dvec3(w.camera.pose().target))));
  w.interaction.hovered.reset();
  w.view.cage = true;  // with which probes are shown
}

void mark_point(Workspace& w) {
  const glm::vec2 at = w.interaction.cursor.value_or(w.viewport.origin + 0.5f * w.viewport.size);
  const auto hit = pick_triangle(w.document, w.posed, w.camera.ray(at, w.viewport));
  if (!hit) return w.messages.info("Point at the model to mark it.");
  if (w.marks.size() == 2) w.marks.clear();
  w.marks.push_back(*hit);
}

bool all_locked(const Workspace& w) {
  const auto& selected = w.document.selection.indices();
  return std::ranges::all_of(selected, [&](auto i) { return w.document.probes.all[i].locked; });
}

void toggle_locked(Workspace& w) {
  set_locked(w.document, !all_locked(w));
}

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

// What is no cage is said, and changes nothing. Of the document, or of the workspace with a word.
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
    w.messages.warn("Nothing is left of these sets: " + lost + "; undo brings them back");
  w.interaction.hovered.reset();
}

template <Tool Use>
void use_tool(Workspace& w) {
  w.tool = Use;
  w.interaction.handle.reset();
}

std::vector<Command> most_commands() {
  using M = sym3::Method;
  using deform::Way;
  using E = deform::Elements;
  using W = deform::Weights;
  using B = deform::Blend;
  using V = StandardView;
  // clang-format off
  return {
      {"open_model", {"Open a model or session", "Open"}, "Open a mesh to deform, or a session.", "File", {key('O'), true}, {}, always,
       browse_for_model},
      {"open_cage", "Open cage", "Open a cage around the model.", "File", {key('O'), true, true}, {}, has_model,
       browse_for_cage},
      {"open_cage_beside", {"Open the cage beside the model", "Open it"}, "Open the file beside the model that looks like its cage.", "File", {}, {},
       has_cage_beside,
       [](Workspace& w) { w.requests.open = OpenRequest{OpenRequest::What::cage, {w.document.cage_beside}}; }},
      {"open_pose", "Open pose", "Open a posed version of this cage.", "File", {key('P'), true}, {}, has_cage,
       browse_for_pose},
      {"save_session", {"Save session", "Save"}, "Save model, cage, pose, settings and camera as a session.", "File", {key('S'), true}, {},
       has_model, save},
      {"save_session_as", {"Save session as", "Save as"}, "Save the session under another name.", "File", {key('S'), true, true}, {},
       has_model, browse_to_save_session},
      {"save_pose", "Save pose", "Write the posed cage to a mesh file.", "File", {key('P'), true, true}, {}, has_cage,
       browse_to_save_pose},
      {"save_cage", "Save cage", "Write the cage at rest to a mesh file.", "File", {}, {}, has_cage, browse_to_save_cage},
      {"save_model", {"Export the deformed mesh", "Export"}, "Write the deformed mesh to a file.", "File", {key('E'), true}, {}, is_movable,
       browse_to_save_model},
      {"stop_work", {"Cancel what is at work", "Cancel"}, "Stop reading, making a cage or binding; everything stays as it is.", "File", {Key::escape}, {}, is_working,
       [](Workspace& w) { w.requests.stop_work = true; }},
      {"stop_export", {"Cancel the export", "Cancel"}, "Stop writing the deformed mesh or its animation; every file is whole or as it was.", "File", {}, {}, is_exporting,
       [](Workspace& w) { w.requests.stop_export = true; }},
      {"restore_leftover", {"Restore unsaved edits", "Restore these edits"}, "Bring unsaved edits back.", "File", {key('B'), true}, {}, has_leftover,
       restore_leftover},
      {"put_off_leftover", {"Keep unsaved edits for later", "Keep them for later"}, "Keep unsaved edits for the next start.", "File", {}, {}, has_leftover,
       put_off_leftover},
      {"discard_leftover", {"Discard unsaved edits", "Discard these edits"}, "Drop unsaved edits; until the program ends they can be brought back.", "File",
       {}, {}, has_leftover, discard_leftover},
      {"undo_discard", {"Bring discarded edits back", "Bring them back"}, "Take back that unsaved edits were discarded.", "File", {key('B'), true, true}, {},
       has_discarded, undo_discard_leftover},
      {"hide_discarded", {"Hide what is said of discarded edits", "OK"}, "Hide this line; until the program ends Ctrl+Shift+B brings the edits back.", "File",
       {}, {}, has_discarded, hide_discarded},
      {"screenshot", {"Save a screenshot", "Screenshot"}, "Save a picture of the window.", "File", {Key::f12}, {}, always,
       [](Workspace& w) { w.requests.screenshot = true; }},
      {"quit", "Quit", "Close the program.", "File", {key('Q'), true}, {}, always,
       [](Workspace& w) { w.requests.quit = true; }},

      {"undo", "Undo", "Take the last edit back.", "Edit", {key('Z'), true}, {}, can_undo,
       step_back},
      {"redo", "Redo", "Repeat the edit that was taken back.", "Edit", {key('Z'), true, true}, {key('Y'), true},
       can_redo, step_forth},
      {"reset_pose", "Reset pose", "Put the whole cage and all probes back to rest.", "Edit", {key('R'), true}, {}, is_posed,
       [](Workspace& w) { reset_pose(w.document); }},
      {"reset_selected", "Reset selected", "Put what is selected back to rest.", "Edit", {Key::delete_key}, {},
       has_posed_selection,
       [](Workspace& w) { reset_selected(w.document, mirror_of(w)); }},

      {"select_vertices", {"Select vertices", "Vertices"}, "Select vertices of the cage.", "Select", {key('1')}, {}, hand_is_free,
       select_by<ElementKind::vertex>},
      {"select_edges", {"Select edges", "Edges"}, "Select edges of the cage.", "Select", {key('2')}, {}, hand_is_free,
       select_by<ElementKind::edge>},
      {"select_faces", {"Select faces", "Faces"}, "Select faces of the cage.", "Select", {key('3')}, {}, hand_is_free,
       select_by<ElementKind::face>},
      {"select_probes", {"Select probes", "Probes"}, "Select probes.", "Select", {key('4')}, {}, hand_is_free, select_by<ElementKind::probe>},
      {"select_all", {"Select all", "All"}, "Select the whole cage, or all probes.", "Select", {key('A')}, {key('A'), true}, with_free_hand<has_elements>,
       select_everything},
      {"select_none", {"Select nothing", "None"}, "Select nothing.", "Select", {key('A'), false, true}, {}, with_free_hand<has_selection>,
       select_nothing},
      {"invert_selection", {"Invert selection", "Invert"}, "Select what is not selected.", "Select", {key('I'), true}, {}, with_free_hand<has_elements>,
       invert_selection},
      {"select_linked", {"Select linked", "Linked"}, "Select what is connected with it or with what is under the cursor.", "Select",
       {key('L')}, {key('L'), true}, with_free_hand<has_selection_or_hover>, select_linked},
      {"select_box", {"Select with a box", "Box"}, "Draw a box from anywhere, also from on a vertex; Shift adds, Ctrl removes.",
       "Select", {key('B')}, {}, can_draw_selection, arm_shape<SelectShape::box>},
      {"select_lasso", {"Select with a lasso", "Lasso"}, "Draw a line around what to select; Shift adds, Ctrl removes.", "Select",
       {key('B'), false, true}, {}, can_draw_selection, arm_shape<SelectShape::lasso>},
      {"select_brush", {"Select with a brush", "Brush"}, "Select with a circle that the wheel sizes; Ctrl removes, Esc puts it away.",
       "Select", {key('C'), false, true}, {}, can_draw_selection, arm_shape<SelectShape::brush>},
      {"stop_selecting", {"Stop selecting with a shape", "Done"}, "Put box, lasso or brush away.", "Select", {Key::escape}, {Key::enter}, is_armed, disarm},
      {"select_more", {"Grow selection", "Grow"}, "Select what is next to it, too.", "Select", {Key::up, true}, {}, with_free_hand<has_selection_of_cage>,
       change_selection<grown>},
      {"select_less", {"Shrink selection", "Shrink"}, "Leave out what is next to what is not selected.", "Select", {Key::down, true}, {},
       with_free_hand<has_selection_of_cage>, change_selection<shrunk>},
      {"select_loop", {"Select loop", "Loop"}, "Select the loop of an edge, or of two neighbouring vertices or faces.", "Select",
       {key('L'), false, true}, {}, with_free_hand<has_selection_of_cage>, select_loop},
      {"select_ring", {"Select ring", "Ring"}, "Select edges that lie opposite, across quads and pairs of triangles that make one.", "Select",
       {key('R'), false, true}, {}, with_free_hand<has_selection_of_cage>, select_ring},
      {"select_similar", {"Select similar", "Similar"}, "Select vertices with as many edges, edges as long, faces as large.", "Select",
       {key('S'), false, true}, {}, with_free_hand<has_selection_of_cage>, select_like<similar>},
      {"select_facing", {"Select what faces alike", "Facing"}, "Select faces that look the same way, or edges that are parallel, within 15 degrees.", "Select",
       {}, {}, with_free_hand<has_selection_of_cage>, select_like<facing>},
      side_command<0, false>("side_x_negative", "X -"), side_command<0, true>("side_x_positive", "X +"),
      side_command<1, false>("side_y_negative", "Y -"), side_command<1, true>("side_y_positive", "Y +"),
      side_command<2, false>("side_z_negative", "Z -"), side_command<2, true>("side_z_positive", "Z +"),
      {"hide_selected", {"Hide selected", "Hide"}, "Hide what is selected: it is not touched until all is shown again.", "Select",
       {key('H'), false, true}, {}, with_free_hand<has_selection_of_cage>, change_groups<hide_selected>},
      {"hide_others", {"Hide all but selected", "Only these"}, "Hide everything of the cage but what is selected.", "Select", {key('H'), true, true}, {},
       with_free_hand<has_selection_of_cage>, change_groups<hide_others>},
      {"show_hidden", {"Show all that is hidden", "Show all"}, "Show everything of the cage again.", "Select", {key('H'), true}, {}, with_free_hand<has_hidden>,
       change_groups<show_all>},
      {"save_set", {"Keep selection as a set", "Keep as set"}, "Keep what is selected as a set, to be selected again by its name.", "Select", {}, {},
       with_free_hand<has_selection_of_cage>, change_groups<save_set>},
      {"toggle_select_visible", {"Select visible only", "Visible only"}, "The mouse selects only what neither model nor cage hide.",
       "Select", {key('Z')}, {}, always, toggle<&ViewOptions::select_visible>},

      {"make_cage", "Make a cage", "Make a cage around the model; sliders say how.", "Cage", {}, {}, can_make_cage,
       [](Workspace& w) { w.making = {.open = true, .wish = w.making.wish, .before = w.document.cage}; }},
      {"make_symmetric_cage", "Make a symmetric cage", "Make a cage around the model whose vertices all have their image in the mirror; Cancel brings the old one back.",
       "Cage", {}, {}, lacks_pairs, make_symmetric_cage},
      {"finish_cage", {"Keep the made cage", "Done"}, "Keep this cage; a preview is made with all care first.", "Cage", {}, {}, is_wishing,
       [](Workspace& w) { w.making.closing = true; }},
      {"cancel_cage", {"Take the made cage back", "Cancel"}, "Take the cage back that was made here.", "Cage", {}, {}, is_making,
       [](Workspace& w) { cancel_making(w.document, w.making); w.interaction.hovered.reset(); }},
      {"hide_cage_offer", {"Hide the offer about the cage", "Not now"}, "Go on without it; the panels Cage and Checks still offer it.", "Cage", {}, {}, has_model,
       [](Workspace& w) {
         w.offer_cage = false;
         if (has_outside(w)) put_badge_away(w.checks);
       }},

      {"edit_cage", "Edit cage", "Change the cage itself, which is shown at rest; the pose is carried along.", "Cage",
       {Key::tab}, {}, can_edit_cage, change_cage<switch_cage_editing>},
      {"split_edges", {"Split edges", "Split"}, "A new vertex in the middle of each selected edge.", "Cage", {}, {}, has_cage_selected,
       change_cage<split_selected>},
      {"cut_faces", {"Cut faces", "Cut"}, "A new vertex in the middle of each selected face.", "Cage", {}, {}, has_cage_selected,
       change_cage<cut_selected>},
      {"extrude_faces", {"Extrude faces", "Extrude"}, "Push the selected faces out, with new faces around them.", "Cage", {}, {},
       has_cage_selected, change_cage<extrude_selected>},
      {"merge_vertices", {"Merge vertices", "Merge"}, "The selected vertices become one.", "Cage", {}, {}, has_cage_selected,
       change_cage<merge_selected>},
      {"remove_elements", {"Remove from the cage", "Remove"}, "Take vertices or edges out of the cage, which stays closed; or faces, which leave a hole.",
       "Cage", {Key::delete_key}, {}, has_cage_selected, change_cage<remove_selected>},
      {"subdivide_cage", {"Subdivide cage", "Subdivide"}, "The same cage with about four times the faces.", "Cage", {}, {}, can_edit_cage,
       change_cage<subdivide_cage>},
      {"mirror_cage", {"Mirror cage", "Mirror"}, "The half with the selection, else the one of larger coordinates, and its image.", "Cage", {}, {},
       can_edit_cage, change_cage<mirror_cage>},
      {"fit_cage", {"Fit cage to the model", "Fit"}, "Move and scale the cage to the model.", "Cage", {}, {}, can_edit_cage, change_cage<fit_cage>},
      {"fit_cage_turned", {"Fit cage to the model, turned", "Fit, turned"}, "Turn, move and scale the cage to the model.", "Cage", {}, {}, can_edit_cage,
       change_cage<fit_turned_and_say>},
      {"snap_outside", {"Snap cage out of the model", "Snap out"}, "Bring selected vertices that are within the model, or touch it, out by the shortest way.", "Cage", {}, {},
       has_cage_selected, change_cage<snap_and_say>},
      {"show_outside", {"Show what is outside of the cage", "Show them"}, "Highlight the vertices of the model that are outside, or hide them again; Checks steps through them.", "Cage", {}, {},
       has_outside, [](Workspace& w) { toggle_finding(w, *outside_finding(w.checks)); }},
      {"enclose_model", {"Enclose the model", "Enclose"}, "Move the cage outward where vertices of the model are outside.", "Cage", {}, {},
       can_edit_cage, change_cage<enclose_and_say>},

      {"tool_select", {"Select tool", "Select"}, "No gizmo: drag an element to move the selection.", "Tool", {key('Q')}, {}, always,
       use_tool<Tool::select>},
      {"tool_move", {"Move tool", "Move"}, "Move the selection by arrows and squares.", "Tool", {key('W')}, {}, always,
       use_tool<Tool::move>},
      {"tool_rotate", {"Rotate tool", "Rotate"}, "Rotate the selection about its centre by rings.", "Tool", {key('E')}, {}, always,
       use_tool<Tool::rotate>},
      {"tool_scale", {"Scale tool", "Scale"}, "Scale the selection about its centre.", "Tool", {key('R')}, {}, always,
       use_tool<Tool::scale>},

      {"tool_paint", {"Paint tool", "Paint"}, "Paint what of the model stays at rest; with Ctrl what follows.",
       "Tool", {key('D')}, {}, is_movable, use_tool<Tool::paint>},
      {"mask_clear", "Clear paint", "All of the model follows the cage again.", "Tool", {}, {}, with_free_hand<has_mask>,
       [](Workspace& w) { set_mask(w.document, nullptr, "clear mask"); }},
      {"mask_invert", "Invert paint", "What follows the cage stays, and the reverse.", "Tool", {}, {}, with_free_hand<is_movable>,
       [](Workspace& w) { set_mask(w.document, inverted(w.document), "invert mask"); }},

      {"add_probe", {"Add a probe", "Add"}, "Place a probe on the model, under the cursor: a frame that moves, turns and stretches what is near it.",
       "Probes", {key('P')}, {}, has_probe_room, add_probe_in_view},
      {"mirror_probe", {"Mirror probes", "Mirror"}, "Place copies of the selected probes on the other side of the model, across the axis in which it is most symmetric.", "Probes",
       {key('P'), false, true}, {}, has_probes_selected, [](Workspace& w) { mirror_probes(w.document, symmetry_axis(w.document)); }},
      {"remove_probe", {"Remove probes", "Remove"}, "Take the selected probes away, but for locked ones.", "Probes", {Key::delete_key, false, true}, {},
       has_free_probes_selected, [](Workspace& w) { remove_probes(w.document); }},
      {"replace_probe", {"Rest probes here", "Rest here"}, "The selected probes stay where they are and let the model go: from there they move it anew.",
       "Probes", {}, {}, has_free_probes_selected, [](Workspace& w) { replace_probes(w.document); }},
      {"toggle_locked", {"Lock probes", "Locked"}, "No hand moves the selected probes; they hold what they hold.", "Probes", {}, {},
       has_probes_selected, toggle_locked},

      method_command<M::diag>("method_diag", '1'), method_command<M::sd>("method_sd", '2'),
      method_command<M::improved_sd>("method_improved_sd", '3'), method_command<M::fast>("method_fast", '4'),

      choice_command<Way::smooth>(), choice_command<Way::paper>(), choice_command<Way::mean_value>(),
      choice_command<Way::rigid>(), choice_command<Way::arap>(), choice_command<Way::local>(),
      choice_command<E::face>(), choice_command<E::polygon>(), choice_command<E::patch>(), choice_command<E::edge>(), choice_command<E::vertex>(),
      choice_command<E::vertex_face>(), choice_command<E::vertex_patch>(), choice_command<E::point>(),
      choice_command<W::inverse>(), choice_command<W::integrated>(), choice_command<W::cut_off>(), choice_command<W::harmonic>(), choice_command<W::biharmonic>(),
      choice_command<W::mean_value>(),
      choice_command<B::srl>(), choice_command<B::slrl>(), choice_command<B::sql>(), choice_command<B::log3>(),
      choice_command<B::sse>(), choice_command<B::log4>(), choice_command<B::mls_affine>(),
      choice_command<B::mls_similarity>(), choice_command<B::mls_rigid>(), choice_command<B::linear>(),
      {"toggle_stitched", {"Stitch the model (ARAP)", "Stitched (ARAP)"},
       "As rigid as possible: the triangles of the model follow the blended maps, and its vertices are solved for. Details keep their shape; a frame takes longer.",
       "Blend", {}, {}, with_free_hand<has_maps>, [](Workspace& w) { set_iterations(w.document, w.document.scheme.stitched() ? 0 : 1); }},
      {"toggle_clamp", "No negative weights", "Weights below 0 become 0, and what they took from the others with them.", "Blend", {}, {},
       with_free_hand<has_clamp>, toggle_weighting<&deform::Weighting::clamp>},
      {"toggle_normalise", "Weights sum to 1",
       "Every vertex that an element reaches at all follows in full: the motion ends with a jump. Else it fades out.", "Blend",
       {}, {}, with_free_hand<has_normalise>, toggle_weighting<&deform::Weighting::normalise>},
      {"toggle_as_before", "As before 0.3", "As in sessions before version 0.3: weights spread along the surface alone, so that parts of a model come apart, and radii are parts of a box along the axes.", "Blend",
       {}, {}, with_free_hand<changed_in_03>, toggle_weighting<&deform::Weighting::as_before>},
      {"reach_shorter", "Shorter reach", "Faces of the cage move only what is near them.", "Blend", {key('K')}, {}, with_free_hand<has_reach>,
       [](Workspace& w) { step_reach(w.document, -1); }},
      {"reach_longer", "Longer reach", "Faces of the cage move what is farther away, too.", "Blend", {key('K'), false, true}, {},
       with_free_hand<has_reach>, [](Workspace& w) { step_reach(w.document, 1); }},

      {"toggle_same_path", "Compare on the same path", "Run Fast link by link in double, too, as the other methods run, so that times compare like with like; else its frame is fused, in float.",
       "Method", {}, {}, uses_method, toggle<&ViewOptions::same_path>},
      {"run_benchmark", {"Measure every method", "Measure"}, "Measure every method on random matrices, beside the view.", "Method", {}, {},
       is_not_measuring, [](Workspace& w) { w.requests.run_benchmark = true; }},
      {"stop_benchmark", {"Stop measuring", "Cancel"}, "Stop measuring; what was measured before stays.", "Method", {}, {},
       is_measuring, [](Workspace& w) { w.requests.stop_benchmark = true; }},

      {"frame_all", "Frame all", "See the whole model and cage.", "View", {key('F'), false, true}, {}, has_model,
       [](Workspace& w) { frame_all(w, true); }},
      {"frame_selection", "Frame selection", "See what is selected, or all if nothing is.", "View", {key('F')}, {},
       has_model, [](Workspace& w) { frame_selection(w, true); }},
      {"view_front", {"Look from the front", "Front"}, "Look from the front.", "View", {Key::pad1}, {}, always, look<V::front>},
      {"view_back", {"Look from the back", "Back"}, "Look from the back.", "View", {Key::pad1, true}, {}, always, look<V::back>},
      {"view_right", {"Look from the right", "Right"}, "Look from the right.", "View", {Key::pad3}, {}, always, look<V::right>},
      {"view_left", {"Look from the left", "Left"}, "Look from the left.", "View", {Key::pad3, true}, {}, always, look<V::left>},
      {"view_top", {"Look from above", "Top"}, "Look from above.", "View", {Key::pad7}, {}, always, look<V::top>},
      {"view_bottom", {"Look from below", "Bottom"}, "Look from below.", "View", {Key::pad7, true}, {}, always, look<V::bottom>},
      {"view_home", {"Look from home", "Home"}, "Look from the front, to the right and above, at all of it.", "View", {Key::home}, {Key::pad0}, always,
       look<V::home>},
      {"toggle_orthographic", {"Orthographic view", "Orthographic"}, "Look without perspective: equal lengths look equal.", "View", {Key::pad5},
       {key('O')}, always, [](Workspace& w) { w.camera.set_orthographic(!w.camera.pose().orthographic); }},
      {"toggle_z_up", "Z up", "Which axis of the file points up: Z, or Y. Files are written as they came.", "View", {key('U')}, {}, always,
       [](Workspace& w) { w.camera.set_up(w.camera.pose().up == UpAxis::z ? UpAxis::y : UpAxis::z); }},
      {"mark_point", {"Mark a point", "Mark"}, "Put a mark on the model under the cursor; between two of them the length is measured.", "View",
       {key('Y')}, {}, has_model, mark_point},
      {"clear_marks", "Clear marks", "Take the marks away.", "View", {key('Y'), false, true}, {}, has_marks,
       [](Workspace& w) { w.marks.clear(); }},
      unit_command<LengthUnit::unknown>("unit_none"), unit_command<LengthUnit::millimetre>("unit_mm"),
      unit_command<LengthUnit::centimetre>("unit_cm"), unit_command<LengthUnit::metre>("unit_m"),
      unit_command<LengthUnit::inch>("unit_in"), unit_command<LengthUnit::foot>("unit_ft"),
      {"toggle_wireframe", {"Show the wireframe", "Wireframe"}, "Show the edges of the mesh.", "View", {key('W'), false, true}, {}, always,
       toggle<&ViewOptions::wireframe>},
      shading_command<Shading::clay>("shading_clay"),
      shading_command<Shading::porcelain>("shading_porcelain"),
      shading_command<Shading::jade>("shading_jade"),
      shading_command<Shading::file>("shading_file"),
      shading_command<Shading::checker>("shading_checker"),
      shading_command<Shading::normals>("shading_normals"),
      shading_command<Shading::zebra>("shading_zebra"),
      {"next_shading", "Next shading", "Show the mesh as clay, porcelain or jade, as it is, with a checker, by normals, with stripes, and so on.", "View",
       {key('V')}, {}, always, show_next_shading},
      {"toggle_model", {"Show the model", "Model"}, "Show the mesh.", "View", {key('M')}, {}, always, toggle<&ViewOptions::model>},
      {"toggle_deformed", {"Show the model deformed", "Deformed"}, "Let cage and probes move the mesh, or see it at rest meanwhile.", "View", {key('N')}, {}, always,
       toggle<&ViewOptions::deformed>},
      {"toggle_cage", {"Show the cage", "Cage"}, "Show the cage and the probes.", "View", {key('C')}, {}, always, toggle<&ViewOptions::cage>},
      {"toggle_grid", {"Show the grid", "Grid"}, "Show the ground grid.", "View", {key('G')}, {}, always, toggle<&ViewOptions::grid>},
      {"toggle_axes", {"Show the axes", "Axes"}, "Show the axes at the top right.", "View", {key('X')}, {}, always,
       toggle<&ViewOptions::axes>},
      {"toggle_ghost", {"Show the cage at rest", "Rest ghost"}, "Show the cage at rest, faintly, while it is posed.", "View", {key('H')}, {},
       always, toggle<&ViewOptions::ghost>},
      {"toggle_error_map", {"Show errors on the mesh", "Error on the mesh"}, "Colour the mesh by the relative error of the exponential at each vertex.",
       "View", {key('E'), false, true}, {}, uses_method, toggle<&ViewOptions::error_map>},
      {"toggle_theme", "Dark theme", "Switch between the dark and the light theme.", "View", {key('T')}, {}, always,
       [](Workspace& w) { w.remembered.dark = w.view.dark = !w.view.dark; }},
      {"toggle_coarse_motion", "Coarse in motion",
       "Draw what moves at half the resolution, and sharp again at rest: faster where a processor draws.", "View", {}, {}, always,
       [](Workspace& w) { w.remembered.coarse_motion = !draws_coarsely(w); }},
      {"toggle_panels", {"Show the panels", "Panels"}, "Show or hide the panels.", "View", {Key::f2}, {}, always,
       toggle<&ViewOptions::panels>},
      {"toggle_full_screen", "Full screen", "Let the window fill the screen, or give it its size back.", "View", {Key::f11}, {}, always,
       [](Workspace& w) { w.full_screen = !w.full_screen; }},
      {"toggle_tools", {"Show the tools column", "Tools column"}, "Show or fold away the column of files, cage and tools.", "View", {}, {}, always,
       toggle_column_of<Column::tools>},
      {"toggle_lab", {"Show the Lab", "Lab"}, "Show or fold away the Lab: method, timings, accuracy and benchmark.", "View", {}, {}, always,
       toggle_column_of<Column::lab>},

      {"help", {"Show every key", "Keys"}, "Show every key and mouse action.", "Help", {Key::f1}, {}, always, toggle<&ViewOptions::help>},
      {"command_palette", {"Find a command", "Commands"}, "Find any command by a few letters of its name, and run it.", "Help", {key('K'), true}, {Key::f3},
       always, [](Workspace& w) { w.palette = {!w.palette.open, true, "", 0}; }},
      {"edit_keys", {"Change keys", "All keys"}, "Every command with its key, to give it another one.", "Help", {}, {}, always,
       [](Workspace& w) { w.key_list = {!w.key_list.open, true, "", false, {}}; }},
      {"show_messages", {"Show all messages", "Messages"}, "Show all that was said since the program was started, or hide it again.", "Help", {}, {}, always,
       [](Workspace& w) { w.show_messages = !w.show_messages; }},
  };
  // clang-format on
}

const std::vector<Command>& table() {
  static const std::vector<Command> all = [] {
    std::vector<Command> commands = most_commands();
    std::ranges::copy(hand_commands(), std::back_inserter(commands));
    std::ranges::copy(time_commands(), std::back_inserter(commands));
    std::ranges::copy(animation_file_commands(), std::back_inserter(commands));
    return commands;
  }();
  return all;
}

}  // namespace

std::span<const Command> commands() {
  return table();
}

std::string choice_command_name(deform::Way way) {
  return command_name("way_", deform::entry(way));
}
std::string choice_command_name(deform::Elements elements) {
  return command_name("elements_", deform::entry(elements));
}
std::string choice_command_name(deform::Weights weights) {
  return command_name("weights_", deform::entry(weights));
}
std::string choice_command_name(deform::Blend blend) {
  return command_name("blend_", deform::entry(blend));
}

const Command* find_command(std::string_view name) {
  for (const auto& command : table()) {
    if (command.name == name) return &command;
  }
  return nullptr;
}

}  // namespace viete::scene
