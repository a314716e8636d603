#include "scene/workspace/hand_commands.h"

#include "scene/hand/mirror_edit.h"
#include "scene/hand/pose_alike.h"
#include "scene/workspace/command_conditions.h"
#include "scene/document/selection_sets.h"

namespace viete::scene {

namespace {

constexpr const char* hand_group = "Hand";

// Where each kind of choice lives.
Pivot& choice(Handling& h, Pivot) {
  return h.pivot;
}
Axes& choice(Handling& h, Axes) {
  return h.axes;
}
MirrorPlane& choice(Handling& h, MirrorPlane) {
  return h.mirror;
}
SoftCurve& choice(Handling& h, SoftCurve) {
  return h.soft.curve;
}
SoftDistance& choice(Handling& h, SoftDistance) {
  return h.soft.distance;
}

// What does not go together with this cage is said, and not chosen.
void choose(Workspace& w, MirrorPlane plane) {
  KnownMirror wanted;
  wanted.follow(w.document.cage, plane);
  if (plane != MirrorPlane::none && w.document.has_cage() && !wanted.mirror)
    return w.messages.info("No plane of symmetry fits the cage; choose X, Y or Z.");
  w.handling.mirror = plane;
  w.mirror = std::move(wanted);
}

template <class Choice>
void choose(Workspace& w, Choice value) {
  choice(w.handling, value) = value;
}

const char* headline(Pivot) {
  return "Pivot: ";
}
const char* headline(Axes) {
  return "Axes: ";
}
const char* headline(MirrorPlane) {
  return "Mirror: ";
}
const char* headline(SoftCurve) {
  return "Falloff: ";
}
const char* headline(SoftDistance) {
  return "Falloff: ";
}

// Said to people in the order of its kind.
template <auto Value>
Command hand_choice() {
  static const std::string name = choice_command_name(Value);
  const HandChoice& entry = entry_of(Value);
  static const std::string label = headline(Value) + std::string(entry.label);
  return {name,         {label, entry.label},
          entry.hint,   hand_group,
          {},           {},
          hand_is_free, [](Workspace& w) { choose(w, Value); }};
}

template <auto First>
void choose_next(Workspace& w) {
  using Choice = decltype(First);
  const std::size_t count = choices(First).size();
  const auto now = static_cast<std::size_t>(choice(w.handling, First));
  choose(w, static_cast<Choice>((now + 1) % count));
}

template <Tool Use>
void grab(Workspace& w) {
  w.interaction.grab = {Use};
}

template <Shape Kind>
void shape(Workspace& w) {
  w.interaction.grab = {Tool::select, Kind};
}

std::optional<std::uint32_t> active_vertex(const Document& document) {
  return document.selection.kind() == ElementKind::vertex ? document.selection.active() : std::nullopt;
}

void copy_pose(Workspace& w) {
  w.copied = {w.document.cage, moving_vertices(w.document), {}, active_vertex(w.document)};
  for (const auto v : w.copied.vertices) w.copied.positions.push_back(w.document.pose.positions[v]);
  w.messages.info("Copied the pose of " + counted(ElementKind::vertex, w.copied.vertices.size()) + ".");
}

void pose_like_copied(Workspace& w) {
  const PosedPart part{w.copied.vertices, w.copied.positions, w.copied.active};
  const std::string why =
      pose_alike(w.document, part, moving_vertices(w.document), active_vertex(w.document), mirror_of(w));
  if (!why.empty()) w.messages.info(why);
}

template <KeyPreset Preset>
Command key_preset_command(std::string_view name) {
  const KeyPresetEntry& entry = all_key_presets()[static_cast<std::size_t>(Preset)];
  static const std::string label = "Keys of " + std::string(entry.label);
  return {name,         {label, entry.label},
          entry.hint,   "Keys",
          {},           {},
          hand_is_free, [](Workspace& w) { w.remembered.keymap.set_preset(Preset); }};
}

constexpr Condition can_grab{
    [](const Workspace& w) { return has_selection(w) && shows_selectable(w) && !in_hand(w); },
    "Select something that is shown first."};

constexpr Condition can_shape{
    [](const Workspace& w) { return can_grab(w) && w.document.selection.kind() != ElementKind::probe; },
    "Select something of the cage first."};
constexpr Condition can_pose_alike{
    [](const Workspace& w) { return w.copied.cage && w.copied.cage == w.document.cage && can_shape(w); },
    "Copy the pose of a part of this cage, then select another part that is built like it."};
constexpr Condition has_copied{
    [](const Workspace& w) { return w.copied.cage && w.copied.cage == w.document.cage && !in_hand(w); },
    "Copy the pose of a part of this cage first."};

void begin_placing_pivot(Workspace& w) {
  w.interaction.placing_pivot = !w.interaction.placing_pivot;
}

constexpr Condition has_mirror{[](const Workspace& w) { return mirror_of(w) && has_cage(w) && !in_hand(w); },
                               "Choose a mirror first."};
constexpr Condition has_mirrored_selection{
    [](const Workspace& w) {
      return has_mirror(w) && has_selection(w) && w.document.selection.kind() != ElementKind::probe;
    },
    "Choose a mirror, and select something of the cage on the side to be copied."};

std::string hand_name(const char* kind, const HandChoice& entry) {
  return kind + std::string(entry.word);
}

}  // namespace

std::string choice_command_name(Pivot pivot) {
  return hand_name("pivot_", entry_of(pivot));
}
std::string choice_command_name(Axes axes) {
  return hand_name("axes_", entry_of(axes));
}
std::string choice_command_name(MirrorPlane plane) {
  return hand_name("mirror_", entry_of(plane));
}
std::string choice_command_name(SoftCurve curve) {
  return hand_name("soft_", entry_of(curve));
}
std::string choice_command_name(SoftDistance distance) {
  return hand_name("soft_", entry_of(distance));
}

std::vector<Command> hand_commands() {
  return {
      {"grab",
       {"Grab the selection", "Grab"},
       "The selection follows the cursor until a click; Esc takes it back.",
       hand_group,
       {},
       {},
       can_grab,
       grab<Tool::move>},
      {"grab_rotate",
       {"Turn the selection", "Turn"},
       "The selection turns with the cursor until a click; Esc takes it back.",
       hand_group,
       {},
       {},
       can_grab,
       grab<Tool::rotate>},
      {"grab_scale",
       {"Resize the selection", "Resize"},
       "The selection grows with the cursor until a click; Esc takes it back.",
       hand_group,
       {},
       {},
       can_grab,
       grab<Tool::scale>},
      {"bend",
       {"Bend the selection", "Bend"},
       "Bend the selection between its ends: from the pivot, or the joint, to the active element or the far "
       "end.",
       hand_group,
       {},
       {},
       can_shape,
       shape<Shape::bend>},
      {"twist",
       {"Twist the selection", "Twist"},
       "Twist the selection between its ends, by any number of turns.",
       hand_group,
       {},
       {},
       can_shape,
       shape<Shape::twist>},
      {"taper",
       {"Taper the selection", "Taper"},
       "Make the selection thinner or thicker towards its far end.",
       hand_group,
       {},
       {},
       can_shape,
       shape<Shape::taper>},
      {"push",
       {"Push the selection", "Push"},
       "Push the selection out along its normals, or pull it in.",
       hand_group,
       {},
       {},
       can_shape,
       shape<Shape::push>},
      {"smooth",
       {"Smooth the selection", "Smooth"},
       "Bring the selection nearer to the mean of its neighbours.",
       hand_group,
       {},
       {},
       can_shape,
       shape<Shape::smooth>},
      {"relax",
       {"Relax the selection", "Relax"},
       "Bring the selection nearer to rest.",
       hand_group,
       {},
       {},
       can_shape,
       shape<Shape::relax>},
      {"flatten",
       {"Flatten the selection", "Flatten"},
       "Bring the selection nearer to the plane that fits it.",
       hand_group,
       {},
       {},
       can_shape,
       shape<Shape::flatten>},
      {"copy_pose",
       "Copy pose",
       "Remember where the selected vertices are.",
       "Hand",
       {key('C'), true},
       {},
       can_shape,
       copy_pose},
      {"paste_pose",
       "Paste pose",
       "Put the vertices whose pose was copied there again; with a mirror also those of the other side.",
       "Hand",
       {key('V'), true},
       {},
       has_copied,
       [](Workspace& w) { paste_pose(w.document, w.copied.vertices, w.copied.positions, mirror_of(w)); }},
      {"pose_alike",
       {"Pose like the copied part", "Pose alike"},
       "The selected part takes the pose of the part that was copied, relative to where each hangs: a hand "
       "as the "
       "other hand.",
       "Hand",
       {key('V'), true, true},
       {},
       can_pose_alike,
       pose_like_copied},
      {"place_pivot",
       "Place pivot",
       "The next click says what the selection turns about: a vertex, an edge or the model's surface.",
       hand_group,
       {key('J')},
       {},
       has_model,
       begin_placing_pivot},
      {"next_pivot",
       "Next pivot",
       "Turn and scale about the median, the active element, and so on.",
       hand_group,
       {key('.')},
       {},
       hand_is_free,
       choose_next<Pivot::median>},
      hand_choice<Pivot::median>(),
      hand_choice<Pivot::active>(),
      hand_choice<Pivot::individual>(),
      hand_choice<Pivot::joint>(),
      hand_choice<Pivot::point>(),
      {"next_axes",
       "Next axes",
       "Move along the axes of the world, the view, the selection, and so on.",
       hand_group,
       {key(',')},
       {},
       hand_is_free,
       choose_next<Axes::world>},
      hand_choice<Axes::world>(),
      hand_choice<Axes::view>(),
      hand_choice<Axes::selection>(),
      hand_choice<Axes::active>(),
      hand_choice<Axes::mirror>(),
      {"next_mirror",
       "Next mirror",
       "Move both sides of the cage across X, Y, Z or the plane that fits, or one side alone.",
       hand_group,
       {key('M'), false, true},
       {},
       hand_is_free,
       choose_next<MirrorPlane::none>},
      hand_choice<MirrorPlane::none>(),
      hand_choice<MirrorPlane::x>(),
      hand_choice<MirrorPlane::y>(),
      hand_choice<MirrorPlane::z>(),
      hand_choice<MirrorPlane::fit>(),
      {"mirror_copy",
       {"Copy pose to the other side", "Copy across"},
       "The other side takes the pose of what is selected, as in the mirror.",
       hand_group,
       {},
       {},
       has_mirrored_selection,
       [](Workspace& w) { copy_to_other_side(w.document, *mirror_of(w)); }},
      {"mirror_swap",
       {"Swap poses of both sides", "Swap sides"},
       "Both sides of the selection, or of the whole cage, change their poses.",
       hand_group,
       {},
       {},
       has_mirror,
       [](Workspace& w) { swap_sides(w.document, *mirror_of(w)); }},
      {"toggle_soft",
       {"Soft selection", "Soft"},
       "What is near the selection goes along, the less the farther; during a drag the wheel changes the "
       "radius.",
       hand_group,
       {key('S')},
       {},
       hand_is_free,
       [](Workspace& w) { w.handling.soft.on = !w.handling.soft.on; }},
      hand_choice<SoftCurve::smooth>(),
      hand_choice<SoftCurve::sharp>(),
      hand_choice<SoftCurve::linear>(),
      hand_choice<SoftCurve::constant>(),
      hand_choice<SoftDistance::edges>(),
      hand_choice<SoftDistance::space>(),
      key_preset_command<KeyPreset::viete>("keys_viete"),
      key_preset_command<KeyPreset::blender>("keys_blender"),
      key_preset_command<KeyPreset::maya>("keys_maya"),
      key_preset_command<KeyPreset::viewer>("keys_viewer"),
  };
}

}  // namespace viete::scene
