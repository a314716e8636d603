// Commands for tools, transforms and probes.
#include <algorithm>
#include <type_traits>

#include "document/elements.h"
#include "document/probes.h"
#include "interact/mirror_edit.h"
#include "workspace/command_tables.h"
#include "workspace/pointer.h"

namespace viete::workspace {

namespace {

template <class Value>
Value& setting_of(document::Handling& h) {
  if constexpr (std::is_same_v<Value, document::Pivot>) return h.pivot;
  if constexpr (std::is_same_v<Value, document::Axes>) return h.axes;
  if constexpr (std::is_same_v<Value, document::MirrorPlane>) return h.mirror;
  if constexpr (std::is_same_v<Value, document::SoftCurve>) return h.soft.curve;
  if constexpr (std::is_same_v<Value, document::SoftDistance>) return h.soft.distance;
}

// Sets the mirror plane. If the cage has no plane of symmetry, shows a message and changes nothing.
void choose(Workspace& w, document::MirrorPlane plane) {
  document::MirrorCache wanted;
  wanted.follow(w.document.cage(), plane);
  if (plane != document::MirrorPlane::none && w.document.has_cage() && !wanted.mirror)
    return w.messages.info("The cage has no plane of symmetry; choose X, Y or Z.");
  w.view.handling.mirror = plane;
  w.view.mirror = std::move(wanted);
}

template <class Value>
void choose(Workspace& w, Value value) {
  setting_of<Value>(w.view.handling) = value;
}

template <class Value>
void add_hand_choices(CommandTable& table, std::string_view headline) {
  add_choices<Value>(table, headline, no_drag_runs, [](Workspace& w, Value value) { choose(w, value); });
}

template <class Value>
void choose_next(Workspace& w) {
  choose(w, next_choice(setting_of<Value>(w.view.handling)));
}

template <interact::Tool Use, interact::Shape Kind = interact::Shape::none>
void grab(Workspace& w) {
  w.view.interaction.grab = {Use, Kind};
}

void copy_pose(Workspace& w) {
  auto& copied = w.panels.copied;
  copied = {w.document.cage(), moving_vertices(w.document), {}};
  for (const auto v : copied.vertices) copied.positions.push_back(w.document.pose().positions[v]);
  w.messages.info("Copied the pose of " + counted(document::ElementKind::vertex, copied.vertices.size()) +
                  ".");
}

constexpr Condition can_grab{"Select a visible element first.", [](const Workspace& w) {
                               return has_selection(w) && shows_selectable(w) && !is_dragging(w);
                             }};

constexpr Condition can_shape{"Select part of the cage first.",
                              [](const Workspace& w) { return can_grab(w) && !selects_probes(w); }};
constexpr Condition has_copied{"Copy a pose of this cage first.", [](const Workspace& w) {
                                 return w.panels.copied.is_of(w.document) && !is_dragging(w);
                               }};

constexpr Condition has_mirror{"Choose a mirror first.", [](const Workspace& w) {
                                 return mirror_of(w) && has_cage(w) && !is_dragging(w);
                               }};
constexpr Condition has_mirrored_selection{
    "Choose a mirror and select the part of the cage to copy.",
    [](const Workspace& w) { return has_mirror(w) && has_selection(w) && !selects_probes(w); }};

template <interact::Tool Use>
Effect uses() {
  const auto use = [](Workspace& w) {
    w.view.tool = Use;
    w.view.interaction.handle.reset();
  };
  return {use, [](const Workspace& w) { return w.view.tool == Use; }};
}

// Adds a probe or pin at the model's point under the cursor. If there is no point, uses the model's point at
// the center of the view, or else the camera's target.
template <bool (*Add)(document::Document&, const document::PosedModel&, const mesh::Point&)>
void add_in_view(Workspace& w) {
  auto at = w.view.interaction.cursor ? model_under(w, *w.view.interaction.cursor) : std::nullopt;
  if (!at) at = model_under(w, w.view.camera.viewport.middle());
  const glm::dvec3 target(w.view.camera.pose().target);
  Add(w.document, w.frame.posed, at.value_or(w.document.space().to_file(target)));
  w.view.interaction.hovered.reset();
  w.view.options.cage = true;  // this option also displays probes
}

bool all_are(const Workspace& w, bool (*holds)(const pose::Probe&)) {
  return std::ranges::all_of(w.document.selection().indices(),
                             [&](auto i) { return holds(w.document.probes().all[i]); });
}

bool all_pull(const Workspace& w) {
  return all_are(w, [](const pose::Probe& p) { return !p.pin || p.pin->pulls; });
}

void toggle_locked(Workspace& w) {
  set_locked(w.document, !all_are(w, [](const pose::Probe& p) { return p.locked; }));
}

}  // namespace

void add_transform_commands(CommandTable& table) {
  table.heading("Transform");
  table.add("grab", {"Move selection", "Move"},
            "Move the selection with the pointer. Click to confirm, Esc to cancel.", can_grab,
            grab<interact::Tool::move>);
  table.add("grab_rotate", {"Rotate selection", "Rotate"},
            "Rotate the selection with the pointer. Click to confirm, Esc to cancel.", can_grab,
            grab<interact::Tool::rotate>);
  table.add("grab_scale", {"Scale selection", "Scale"},
            "Scale the selection with the pointer. Click to confirm, Esc to cancel.", can_grab,
            grab<interact::Tool::scale>);
  table.add("bend", {"Bend selection", "Bend"},
            "Bend the selection between the pivot or joint and the active element or far end.", can_shape,
            grab<interact::Tool::select, interact::Shape::bend>);
  table.add("twist", {"Twist selection", "Twist"}, "Twist the selection between its ends by any angle.",
            can_shape, grab<interact::Tool::select, interact::Shape::twist>);
  table.add("taper", {"Taper selection", "Taper"}, "Scale the selection, increasingly towards its far end.",
            can_shape, grab<interact::Tool::select, interact::Shape::taper>);
  table.add("smooth", {"Smooth selection", "Smooth"},
            "Move the selection towards the mean of its neighbours.", can_shape,
            grab<interact::Tool::select, interact::Shape::smooth>);
  table.add("relax", {"Relax selection", "Relax"}, "Move the selection towards its rest position.", can_shape,
            grab<interact::Tool::select, interact::Shape::relax>);
  table.add("copy_pose", "Copy pose", "Copy the positions of the selected vertices.", {key('C'), true},
            can_shape, copy_pose);
  table.add("paste_pose", "Paste pose",
            "Paste the copied vertex positions. With a mirror, paste them on the other side too.",
            {key('V'), true}, has_copied, [](Workspace& w) {
              interact::paste_pose(w.document, w.panels.copied.vertices, w.panels.copied.positions,
                                   mirror_of(w));
            });
  table.add("place_pivot", "Place pivot",
            "Place the pivot with the next click: on a vertex or the model's surface.", {key('J')}, has_model,
            [](Workspace& w) { w.view.interaction.placing_pivot ^= true; });
  table.add("next_pivot", "Next pivot", "Switch to the next pivot: median, active element and so on.",
            {key('.')}, no_drag_runs, choose_next<document::Pivot>);
  add_hand_choices<document::Pivot>(table, "Pivot");
  table.add("next_axes", "Next axes", "Switch to the next axes: world, view, selection and so on.",
            {key(',')}, no_drag_runs, choose_next<document::Axes>);
  add_hand_choices<document::Axes>(table, "Axes");
  table.add("next_mirror", "Next mirror", "Switch to the next mirror: X, Y, Z, best-fit plane or off.",
            {key('M'), false, true}, no_drag_runs, choose_next<document::MirrorPlane>);
  add_hand_choices<document::MirrorPlane>(table, "Mirror");
  table.add("mirror_copy", "Copy to other side", "Copy the mirrored pose of the selection to the other side.",
            has_mirrored_selection,
            [](Workspace& w) { interact::copy_to_other_side(w.document, *mirror_of(w)); });
  table.add("mirror_swap", "Swap sides",
            "Exchange the mirrored poses of the selection and its other side. Without a selection, exchange "
            "the sides of the whole cage.",
            has_mirror, [](Workspace& w) { interact::swap_sides(w.document, *mirror_of(w)); });
  table.add("toggle_soft", {"Soft selection", "Soft selection"},
            "Move neighbours along with the selection, less with distance. The wheel changes the radius "
            "during a drag.",
            {key('S')}, no_drag_runs, [](Workspace& w) { w.view.handling.soft.on ^= true; });
  add_hand_choices<document::SoftCurve>(table, "Falloff");
  add_hand_choices<document::SoftDistance>(table, "Falloff");
  table.heading("Keys");
  add_choices<KeyPreset>(table, "Keymap", no_drag_runs,
                         [](Workspace& w, KeyPreset preset) { w.preferences.keymap.set_preset(preset); });
}

void add_tool_commands(CommandTable& table) {
  table.heading("Tool");
  table.add("tool_select", {"Select tool", "Select"}, "Select elements and drag them without a gizmo.",
            {key('Q')}, always, uses<interact::Tool::select>());
  table.add("tool_move", {"Move tool", "Move"}, "Show arrows and planes that move the selection.", {key('W')},
            always, uses<interact::Tool::move>());
  table.add("tool_rotate", {"Rotate tool", "Rotate"}, "Show rings that rotate the selection about its pivot.",
            {key('E')}, always, uses<interact::Tool::rotate>());
  table.add("tool_scale", {"Scale tool", "Scale"}, "Show handles that scale the selection about its pivot.",
            {key('R')}, always, uses<interact::Tool::scale>());
  table.add("tool_paint", {"Paint tool", "Paint"},
            "Paint vertices of the model that stay at rest. Ctrl erases.", {key('D')}, is_movable,
            uses<interact::Tool::paint>());
  table.add("mask_clear", "Clear paint", "Clear the painted mask so that the whole model follows the cage.",
            without_drag<has_mask>, [](Workspace& w) { set_mask(w.document, nullptr, "clear mask"); });
  table.add("mask_invert", "Invert paint", "Exchange painted and unpainted vertices.",
            without_drag<is_movable>,
            [](Workspace& w) { set_mask(w.document, inverted(w.document), "invert mask"); });
  table.heading("Probes");
  table.add("add_probe", {"Add probe", "Add"},
            "Add a probe at the model point under the pointer, or in the middle of the view. It moves, "
            "rotates and stretches the model nearby.",
            {key('P')}, has_probe_room, add_in_view<document::add_probe>);
  table.add(
      "add_pin", {"Pin vertex", "Pin"},
      "Pin the vertex under the pointer, or in the middle of the view. Drag pins to pose the model by its "
      "shapes, or rigidly.",
      {key('P'), false, false, true}, has_pin_room, add_in_view<document::add_pin>);
  table.add("toggle_pulls", {"Make pins soft", "Soft pins"},
            "Pull vertices softly towards the selected pins. When off, the vertices are exactly at the pins.",
            has_pins_selected,
            {[](Workspace& w) { set_pulls(w.document, !all_pull(w)); },
             [](const Workspace& w) { return has_pins_selected(w) && all_pull(w); }});
  table.add("mirror_probe", {"Mirror probes", "Mirror"},
            "Add mirrored copies of the selected probes on the other side of the model's plane of symmetry.",
            {key('P'), false, true}, has_probes_selected,
            [](Workspace& w) { mirror_probes(w.document, symmetry_axis(w.document)); });
  table.add("remove_probe", {"Remove probes", "Remove"}, "Remove the selected probes. Locked probes stay.",
            {Key::delete_key, false, true}, has_free_probes_selected,
            [](Workspace& w) { remove_probes(w.document); });
  table.add("toggle_locked", {"Lock probes", "Locked"},
            "Lock the selected probes. They keep acting but cannot be dragged.", has_probes_selected,
            toggle_locked);
}

}  // namespace viete::workspace
