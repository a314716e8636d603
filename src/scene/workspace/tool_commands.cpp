#include "scene/workspace/command_tables.h"

#include <algorithm>

#include "scene/document/edit.h"
#include "scene/document/probes.h"
#include "scene/hand/mirror_edit.h"
#include "scene/workspace/command_conditions.h"
#include "scene/workspace/pointer.h"

namespace viete::scene {

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

// On the model under the cursor or, where none is there or a button was pressed, in the middle of the view.
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
  w.view.cage = true;  // with which probes are shown
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
  table.add("mask_clear", "Clear paint", "All of the model follows the cage again.", with_free_hand<has_mask>,
            [](Workspace& w) { set_mask(w.document, nullptr, "clear mask"); });
  table.add("mask_invert", "Invert paint", "What follows the cage stays, and the reverse.",
            with_free_hand<is_movable>,
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
