// Commands for tools and handling.
#include <algorithm>

#include "scene/document/edit.h"
#include "scene/document/probes.h"
#include "scene/document/selection_sets.h"
#include "scene/hand/mirror_edit.h"
#include "scene/workspace/choice_commands.h"
#include "scene/workspace/command_conditions.h"
#include "scene/workspace/command_tables.h"
#include "scene/workspace/pointer.h"

namespace viete::scene {

namespace {

// The field for each kind of choice.
Pivot& place(Handling& h, Pivot) {
  return h.pivot;
}
Axes& place(Handling& h, Axes) {
  return h.axes;
}
MirrorPlane& place(Handling& h, MirrorPlane) {
  return h.mirror;
}
SoftCurve& place(Handling& h, SoftCurve) {
  return h.soft.curve;
}
SoftDistance& place(Handling& h, SoftDistance) {
  return h.soft.distance;
}

// Reports a plane that does not fit the cage, without a change.
void choose(Workspace& w, MirrorPlane plane) {
  MirrorCache wanted;
  wanted.follow(w.document.cage, plane);
  if (plane != MirrorPlane::none && w.document.has_cage() && !wanted.mirror)
    return w.messages.info("No plane of symmetry fits the cage; choose X, Y or Z.");
  w.handling.mirror = plane;
  w.mirror = std::move(wanted);
}

template <class Value>
void choose(Workspace& w, Value value) {
  place(w.handling, value) = value;
}

template <class Value>
void add_hand_choices(CommandTable& table, std::string_view headline) {
  add_choices<Value>(table, headline, no_drag_runs, [](Workspace& w, Value value) { choose(w, value); });
}

template <class Value>
void choose_next(Workspace& w) {
  choose(w, next_choice(place(w.handling, Value{})));
}

template <Tool Use>
void grab(Workspace& w) {
  w.interaction.grab = {Use};
}

template <Shape Kind>
void shape(Workspace& w) {
  w.interaction.grab = {Tool::select, Kind};
}

void copy_pose(Workspace& w) {
  w.copied = {w.document.cage, moving_vertices(w.document), {}};
  for (const auto v : w.copied.vertices) w.copied.positions.push_back(w.document.pose.positions[v]);
  w.messages.info("Copied the pose of " + counted(ElementKind::vertex, w.copied.vertices.size()) + ".");
}

void add_key_presets(CommandTable& table) {
  int number = 0;
  for (const Choice& entry : choices(KeyPreset{})) {
    const auto preset = static_cast<KeyPreset>(number++);
    const std::string label(entry.label);
    table
        .add(choice_command_name(preset), {"Keys of " + label, label}, std::string(entry.hint), no_drag_runs,
             [preset](Workspace& w) { w.preferences.keymap.set_preset(preset); })
        .under("Keys of");
  }
}

constexpr Condition can_grab{
    [](const Workspace& w) { return has_selection(w) && shows_selectable(w) && !is_dragging(w); },
    "Select something that is shown first."};

constexpr Condition can_shape{
    [](const Workspace& w) { return can_grab(w) && w.document.selection.kind() != ElementKind::probe; },
    "Select something of the cage first."};
constexpr Condition has_copied{
    [](const Workspace& w) { return w.copied.cage && w.copied.cage == w.document.cage && !is_dragging(w); },
    "Copy the pose of a part of this cage first."};

void begin_placing_pivot(Workspace& w) {
  w.interaction.placing_pivot = !w.interaction.placing_pivot;
}

constexpr Condition has_mirror{
    [](const Workspace& w) { return mirror_of(w) && has_cage(w) && !is_dragging(w); },
    "Choose a mirror first."};
constexpr Condition has_mirrored_selection{
    [](const Workspace& w) {
      return has_mirror(w) && has_selection(w) && w.document.selection.kind() != ElementKind::probe;
    },
    "Choose a mirror, and select something of the cage on the side to be copied."};

}  // namespace

void add_hand_commands(CommandTable& table) {
  table.heading("Transform");
  table.add("grab", {"Grab the selection", "Grab"},
            "The selection follows the cursor until a click; Esc takes it back.", can_grab, grab<Tool::move>);
  table.add("grab_rotate", {"Turn the selection", "Turn"},
            "The selection turns with the cursor until a click; Esc takes it back.", can_grab,
            grab<Tool::rotate>);
  table.add("grab_scale", {"Resize the selection", "Resize"},
            "The selection grows with the cursor until a click; Esc takes it back.", can_grab,
            grab<Tool::scale>);
  table.add(
      "bend", {"Bend the selection", "Bend"},
      "Bend the selection between its ends: from the pivot, or the joint, to the active element or the far "
      "end.",
      can_shape, shape<Shape::bend>);
  table.add("twist", {"Twist the selection", "Twist"},
            "Twist the selection between its ends, by any number of turns.", can_shape, shape<Shape::twist>);
  table.add("taper", {"Taper the selection", "Taper"},
            "Make the selection thinner or thicker towards its far end.", can_shape, shape<Shape::taper>);
  table.add("push", {"Push the selection", "Push"},
            "Push the selection out along its normals, or pull it in.", can_shape, shape<Shape::push>);
  table.add("smooth", {"Smooth the selection", "Smooth"},
            "Bring the selection nearer to the mean of its neighbours.", can_shape, shape<Shape::smooth>);
  table.add("relax", {"Relax the selection", "Relax"}, "Bring the selection nearer to rest.", can_shape,
            shape<Shape::relax>);
  table.add("flatten", {"Flatten the selection", "Flatten"},
            "Bring the selection nearer to the plane that fits it.", can_shape, shape<Shape::flatten>);
  table.add("copy_pose", "Copy pose", "Remember where the selected vertices are.", {key('C'), true},
            can_shape, copy_pose);
  table.add("paste_pose", "Paste pose",
            "Put the vertices whose pose was copied there again; with a mirror also those of the other side.",
            {key('V'), true}, has_copied, [](Workspace& w) {
              paste_pose(w.document, w.copied.vertices, w.copied.positions, mirror_of(w));
            });
  table.add("place_pivot", "Place pivot",
            "The next click says what the selection turns about: a vertex, an edge or the model's surface.",
            {key('J')}, has_model, begin_placing_pivot);
  table.add("next_pivot", "Next pivot", "Turn and scale about the median, the active element, and so on.",
            {key('.')}, no_drag_runs, choose_next<Pivot>);
  add_hand_choices<Pivot>(table, "Pivot");
  table.add("next_axes", "Next axes", "Move along the axes of the world, the view, the selection, and so on.",
            {key(',')}, no_drag_runs, choose_next<Axes>);
  add_hand_choices<Axes>(table, "Axes");
  table.add("next_mirror", "Next mirror",
            "Move both sides of the cage across X, Y, Z or the plane that fits, or one side alone.",
            {key('M'), false, true}, no_drag_runs, choose_next<MirrorPlane>);
  add_hand_choices<MirrorPlane>(table, "Mirror");
  table.add("mirror_copy", {"Copy pose to the other side", "Copy across"},
            "The other side takes the pose of what is selected, as in the mirror.", has_mirrored_selection,
            [](Workspace& w) { copy_to_other_side(w.document, *mirror_of(w)); });
  table.add("mirror_swap", {"Swap poses of both sides", "Swap sides"},
            "Both sides of the selection, or of the whole cage, change their poses.", has_mirror,
            [](Workspace& w) { swap_sides(w.document, *mirror_of(w)); });
  table.add(
      "toggle_soft", {"Soft selection", "Soft"},
      "What is near the selection goes along, the less the farther; during a drag the wheel changes the "
      "radius.",
      {key('S')}, no_drag_runs, [](Workspace& w) { w.handling.soft.on = !w.handling.soft.on; });
  add_hand_choices<SoftCurve>(table, "Falloff");
  add_hand_choices<SoftDistance>(table, "Falloff");
  table.heading("Keys");
  add_key_presets(table);
}

namespace {

template <Tool Use>
void use_tool(Workspace& w) {
  w.tool = Use;
  w.interaction.handle.reset();
}

template <Tool Use>
bool in_use(const Workspace& w) {
  return w.tool == Use;
}

// Adds at the model under the cursor, or at the view's center if there is none or a panel button was used.
template <bool (*Add)(Document&, const PosedModel&, const mesh::Point&)>
void add_in_view(Workspace& w) {
  const glm::vec2 middle = w.viewport.middle();
  const auto on_model = [&](const glm::vec2& at) {
    return pick_model(w.document, w.posed, w.camera.ray(at, w.viewport));
  };
  auto at = w.interaction.cursor ? on_model(*w.interaction.cursor) : std::nullopt;
  if (!at) at = on_model(middle);
  Add(w.document, w.posed, at.value_or(w.document.space.to_file(glm::dvec3(w.camera.pose().target))));
  w.interaction.hovered.reset();
  w.view.cage = true;  // also displays the probes
}

bool all_pull(const Workspace& w) {
  return std::ranges::all_of(w.document.selection.indices(), [&](auto i) {
    const deform::Probe& probe = w.document.probes.all[i];
    return !probe.pin || probe.pin->pulls;
  });
}

bool all_locked(const Workspace& w) {
  const auto& selected = w.document.selection.indices();
  return std::ranges::all_of(selected, [&](auto i) { return w.document.probes.all[i].locked; });
}

void toggle_locked(Workspace& w) {
  set_locked(w.document, !all_locked(w));
}

}  // namespace

void add_tool_commands(CommandTable& table) {
  table.heading("Tool");
  table.add("tool_select", {"Select tool", "Select"}, "No gizmo: drag an element to move the selection.",
            {key('Q')}, always,
            {use_tool<Tool::select>, [](const Workspace& w) { return w.tool == Tool::select; }});
  table.add("tool_move", {"Move tool", "Move"}, "Move the selection by arrows and squares.", {key('W')},
            always, {use_tool<Tool::move>, [](const Workspace& w) { return w.tool == Tool::move; }});
  table.add("tool_rotate", {"Rotate tool", "Rotate"}, "Rotate the selection about its centre by rings.",
            {key('E')}, always,
            {use_tool<Tool::rotate>, [](const Workspace& w) { return w.tool == Tool::rotate; }});
  table.add("tool_scale", {"Scale tool", "Scale"}, "Scale the selection about its centre.", {key('R')},
            always, {use_tool<Tool::scale>, [](const Workspace& w) { return w.tool == Tool::scale; }});
  table.add("tool_paint", {"Paint tool", "Paint"},
            "Paint what of the model stays at rest; with Ctrl what follows.", {key('D')}, is_movable,
            {use_tool<Tool::paint>, [](const Workspace& w) { return w.tool == Tool::paint; }});
  table.add("mask_clear", "Clear paint", "All of the model follows the cage again.", without_drag<has_mask>,
            [](Workspace& w) { set_mask(w.document, nullptr, "clear mask"); });
  table.add("mask_invert", "Invert paint", "What follows the cage stays, and the reverse.",
            without_drag<is_movable>,
            [](Workspace& w) { set_mask(w.document, inverted(w.document), "invert mask"); });
  table.heading("Probes");
  table.add("add_probe", {"Add a probe", "Add"},
            "Place a probe on the model, under the cursor: a frame that moves, turns and stretches what is "
            "near it.",
            {key('P')}, has_probe_room, add_in_view<add_probe>);
  table.add(
      "add_pin", {"Pin a vertex", "Pin"},
      "Pin the vertex of the model under the cursor. Drag pins, and the model follows by the shapes of the "
      "list of poses; without any it stays as rigid as it can.",
      {key('P'), false, false, true}, has_probe_room, add_in_view<add_pin>);
  table.add("toggle_pulls", {"Pull by pins", "Pulls"},
            "The selected pins pull their vertices towards them; else they hold them there.",
            has_pins_selected,
            {[](Workspace& w) { set_pulls(w.document, !all_pull(w)); },
             [](const Workspace& w) { return has_pins_selected(w) && all_pull(w); }});
  table.add("mirror_probe", {"Mirror probes", "Mirror"},
            "Place copies of the selected probes on the other side of the model, across the axis in which it "
            "is most symmetric.",
            {key('P'), false, true}, has_probes_selected,
            [](Workspace& w) { mirror_probes(w.document, symmetry_axis(w.document)); });
  table.add("remove_probe", {"Remove probes", "Remove"},
            "Take the selected probes away, but for locked ones.", {Key::delete_key, false, true},
            has_free_probes_selected, [](Workspace& w) { remove_probes(w.document); });
  table.add("replace_probe", {"Rest probes here", "Rest here"},
            "The selected probes stay where they are and let the model go: from there they move it anew.",
            has_free_probes_selected, [](Workspace& w) { replace_probes(w.document); });
  table.add("toggle_locked", {"Lock probes", "Locked"},
            "No hand moves the selected probes; they hold what they hold.", has_probes_selected,
            toggle_locked);
}

}  // namespace viete::scene
