#include "workspace/pointer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "document/elements.h"
#include "document/probes.h"
#include "interact/cursor_projection.h"

namespace viete::workspace {

namespace {

document::SelectMode mode_of(const PointerInput& input) {
  if (input.shift) return document::SelectMode::add;
  return input.ctrl ? document::SelectMode::remove : document::SelectMode::replace;
}

// `small` is true if a vertex or probe is under the cursor. Then a handle must be exactly under the cursor.
std::optional<interact::Constraint> handle_under(const Workspace& w, const glm::vec2& cursor, bool small) {
  const auto gizmo = gizmo_of(w);
  if (!gizmo) return std::nullopt;
  const auto handle = pick_handle(*gizmo, cursor);
  return handle || small ? handle : pick_handle(*gizmo, cursor, true);
}

// True for a vertex or probe. Edges and faces do not count, because almost every handle is near one.
bool is_small(const Workspace& w, const std::optional<interact::Pick>& element) {
  const document::ElementKind kind = w.document.selection().kind();
  return element && (kind == document::ElementKind::vertex || kind == document::ElementKind::probe);
}

bool over_axes(const Workspace& w, const glm::vec2& cursor) {
  const auto axes = axis_widget_of(w);
  return axes && axes->contains(cursor);
}

glm::dvec3 in_view(const document::Document& document, const glm::dvec3& place) {
  return glm::dvec3(document.space().to_view({place.x, place.y, place.z}));
}

interact::Anchor anchor_of(const Workspace& w) {
  return interact::anchor_of(w.document, w.view.handling, mirror_of(w), w.view.camera);
}

mesh::Point beside_target(const Workspace& w, const glm::vec2& cursor) {
  auto& camera = w.view.camera;
  const glm::dvec3 target(camera.pose().target);
  const interact::CursorProjection projection(target, camera);
  const auto at = projection.in_plane(-glm::dvec3(camera.forward()), camera.ray(cursor));
  return w.document.space().to_file(at.value_or(target));
}

// Positions from `from` (excluded) to `to`, at most `apart` pixels apart, so that fast strokes have no gaps.
std::vector<glm::vec2> steps_between(const glm::vec2& from, const glm::vec2& to, float apart) {
  const int steps = std::max(1, static_cast<int>(std::ceil(glm::distance(from, to) / apart)));
  std::vector<glm::vec2> all;
  for (int step = 1; step <= steps; ++step)
    all.push_back(glm::mix(from, to, static_cast<float>(step) / static_cast<float>(steps)));
  return all;
}

using Seen = std::vector<std::optional<glm::vec3>>;

void hide(interact::Sight& sight, const Seen& points, std::span<const mesh::Triangle> triangles) {
  for (const auto& t : triangles)
    if (points[t[0]] && points[t[1]] && points[t[2]])
      sight.hide_behind(*points[t[0]], *points[t[1]], *points[t[2]]);
}

// In the result, elements behind the model or behind faces of the cage are hidden.
interact::Sight sight_of(const Workspace& w) {
  interact::Sight sight(w.view.camera);
  const interact::Projector project(w.document.space(), w.view.camera);
  Seen points;
  if (w.view.options.model && w.document.model().surface) {
    const mesh::Surface& model = *w.document.model().surface;
    points.reserve(model.positions.size());
    for (std::size_t v = 0; v < model.positions.size(); ++v)
      points.push_back(project(w.frame.posed.at(model, v)));
    hide(sight, points, model.triangles);
  }
  if (w.document.has_cage()) {
    points.clear();
    for (const auto& p : w.document.pose().positions) points.push_back(project(p));
    const auto hidden = hidden_elements(w.document, document::ElementKind::face);
    const mesh::Surface& cage = w.document.cage()->surface;
    std::vector<mesh::Triangle> triangles;
    for (std::size_t t = 0; t < cage.triangles.size(); ++t)
      if (!hidden[cage.triangle_polygon[t]]) triangles.push_back(cage.triangles[t]);
    hide(sight, points, triangles);
  }
  return sight;
}

}  // namespace

std::optional<mesh::Point> model_under(const Workspace& w, const glm::vec2& cursor) {
  return pick_model(w.document, w.frame.posed, w.view.camera.ray(cursor));
}

mesh::Point pivot_place(const Workspace& w, const glm::vec2& cursor) {
  if (w.document.has_cage() && w.view.options.cage) {
    const auto vertex =
        interact::pick_element(w.document, document::ElementKind::vertex, w.view.camera, cursor);
    if (vertex) return w.document.pose().positions[vertex->index];
  }
  const auto on_model = model_under(w, cursor);
  return on_model ? *on_model : beside_target(w, cursor);
}

const interact::Sight* SightCache::of(const Workspace& w) {
  if (!w.view.options.select_visible) return nullptr;
  const Picture now{w.view.camera.pose(),      w.view.camera.viewport,        w.document.revisions(),
                    w.frame.posed.frame,       w.frame.posed.vertices.data(), w.view.options.model,
                    w.document.groups().hidden};
  if (picture_ != now) {
    picture_ = now;
    sight_.emplace(sight_of(w));
  }
  return &*sight_;
}

void arm(Workspace& w, interact::SelectShape shape) {
  const bool again = w.view.interaction.armed == shape;
  disarm(w);
  if (!again) w.view.interaction.armed = shape;
}

void disarm(Workspace& w) {
  w.view.interaction.armed.reset();
}

std::optional<interact::Gizmo> gizmo_of(const Workspace& w) {
  if (!shows_selectable(w) || w.document.selection().empty()) return std::nullopt;
  if (w.document.selection().kind() == document::ElementKind::probe && !has_free_probes(w.document))
    return std::nullopt;
  auto& interaction = w.view.interaction;
  const interact::Tool tool = interaction.drag ? interaction.drag->tool() : w.view.tool;
  const interact::Anchor anchor = anchor_of(w);
  // During rotation and scaling, the gizmo stays at the pivot. During a move, the gizmo moves too.
  const bool turning = interaction.drag && interaction.drag->tool() != interact::Tool::move;
  const glm::dvec3& center = turning ? interaction.drag->grip().anchor.center : anchor.center;
  const glm::dmat3& axes = interaction.drag ? interaction.drag->grip().anchor.axes : anchor.axes;
  return make_gizmo(tool, in_view(w.document, center), axes, w.view.camera);
}

interact::Grip grip_of(const Workspace& w) {
  return interact::grip_of(w.document, w.view.handling, mirror_of(w), w.view.camera);
}

std::optional<interact::AxisWidget> axis_widget_of(const Workspace& w) {
  const bool shown = w.view.options.axes && w.view.options.panels && w.document.model().surface;
  return shown ? interact::axis_widget(w.view.camera) : std::nullopt;
}

void Pointer::frame(Workspace& w, const PointerInput& input) {
  w.view.mirror.follow(w.document.cage(), w.view.handling.mirror);
  // A change of the document or the cage ends the gesture.
  const document::Revisions& now = w.document.revisions();
  if (surfaces_ != now.surfaces || cage_ != now.cage) {
    surfaces_ = now.surfaces;
    cage_ = now.cage;
    if (active()) finish(w, Gesture::ignored);
  }
  if (w.view.interaction.placing_pivot && input.escape) w.view.interaction.placing_pivot = false;
  if (w.view.interaction.grab && !active()) begin_grab(w, input);
  if (gesture_ == Gesture::grabbed) end_grab(w, input);
  const bool left_gesture = active() && gesture_ != Gesture::ignored && button_ == left_button;
  if (left_gesture && (input.escape || pressed_now(input, right_button))) {
    cancel(w);
  } else if (!active()) {
    press(w, input);
  }
  if (active()) move(w, input);
  if (active() && gesture_ != Gesture::grabbed && !input.down[button_]) release(w, input);
  if (!active()) hover(w, input);
  const bool free = !active() || gesture_ == Gesture::brushing;
  if (free && input.over_view && input.wheel != 0) turn_wheel(w, input);
  last_ = input;
}

void Pointer::turn_wheel(Workspace& w, const PointerInput& input) {
  const float factor = std::pow(1.1f, input.wheel);
  float& select_radius = w.view.interaction.select_radius;
  if (w.view.interaction.armed == interact::SelectShape::brush) {
    select_radius =
        std::clamp(select_radius * factor, interact::least_select_radius, interact::largest_select_radius);
  } else if (shows_mask(w) && input.shift) {
    const float radius = w.view.brush.radius * factor;
    w.view.brush.radius = std::clamp(radius, document::Brush::least_radius, document::Brush::largest_radius);
  } else {
    w.view.camera.zoom(input.wheel, input.position);
  }
}

std::optional<interact::Pick> Pointer::element_under(const Workspace& w, const glm::vec2& cursor) {
  if (!shows_selectable(w)) return std::nullopt;
  return pick_element(w.document, w.view.camera, cursor, sight_.of(w));
}

// Priority under the cursor: axis widget, armed tool, paint tool, gizmo handle, element.
void Pointer::hover(Workspace& w, const PointerInput& input) {
  Interaction& interaction = w.view.interaction;
  interaction.over_axes = input.over_view && over_axes(w, input.position);
  const bool free = input.over_view && !interaction.over_axes;
  interaction.brush.reset();
  interaction.crowded = false;
  interaction.cursor = free ? std::optional(input.position) : std::nullopt;
  if (free && (interaction.armed || shows_mask(w))) {
    interaction.handle.reset();
    interaction.hovered.reset();
    if (!interaction.armed) interaction.brush = model_under(w, input.position);
    return;
  }
  auto pick = free ? element_under(w, input.position) : std::nullopt;
  interaction.handle = free ? handle_under(w, input.position, is_small(w, pick)) : std::nullopt;
  if (interaction.handle) pick.reset();
  interaction.hovered = pick ? std::optional(pick->index) : std::nullopt;
  interaction.crowded = pick && is_crowded(w.document, w.view.camera, input.position, sight_.of(w));
}

void Pointer::press(Workspace& w, const PointerInput& input) {
  if (!input.over_view) return;
  for (const int button : {left_button, right_button, middle_button}) {
    if (!pressed_now(input, button)) continue;
    button_ = button;
    travelled_ = false;
    press_ = input.position;
    last_.position = input.position;
    if (button == left_button && !input.alt) return press_left(w, input);
    gesture_ = camera_gesture(w, button, input);
    return;
  }
}

Pointer::Gesture Pointer::camera_gesture(const Workspace& w, int button, const PointerInput& input) const {
  const Keymap& keys = w.preferences.keymap;
  if (keys.alt_moves_camera() && input.alt && button == middle_button) return Gesture::panning;
  if (keys.alt_moves_camera() && input.alt && button == right_button) return Gesture::zooming;
  if (keys.left_orbits() && button == right_button) return Gesture::panning;
  return input.shift ? Gesture::panning : input.ctrl ? Gesture::zooming : Gesture::orbiting;
}

// Starts a transform without a pressed button. The selection then follows the cursor.
void Pointer::begin_grab(Workspace& w, const PointerInput& input) {
  const bool wanted = !input.escape && shows_selectable(w) && !w.document.selection().empty();
  if (wanted && !input.over_view) return;  // wait until the pointer is in the view
  const auto [tool, shape] = *std::exchange(w.view.interaction.grab, std::nullopt);
  if (!wanted) return;
  gesture_ = Gesture::grabbed;
  button_ = left_button;
  press_ = last_.position = input.position;
  grabbed_.reset();
  handle_.reset();
  selection_before_ = w.document.selection();
  interact::Grip grip = grip_of(w);
  if (shape != interact::Shape::none)
    grip.shaping =
        shaping_of(w.document, shape, grip, w.view.handling.pivot == document::Pivot::median, w.view.camera);
  if (grip.shaping.shape != shape) {
    gesture_ = Gesture::none;
    return w.messages.info("The selection must have two ends to " + std::string(name(shape)) + " it.");
  }
  const double depth = w.view.camera.depth(glm::vec3(in_view(w.document, grip.anchor.center)));
  w.view.interaction.handle.reset();
  w.view.interaction.hovered.reset();
  w.view.interaction.drag.emplace(w.document, std::move(grip), tool, interact::Constraint{}, depth, press_,
                                  w.view.camera);
}

void Pointer::end_grab(Workspace& w, const PointerInput& input) {
  if (!pressed_now(input, left_button)) return;
  w.view.interaction.drag->commit(w.document);
  w.view.options.hints = false;
  finish(w, Gesture::ignored);
}

void Pointer::press_left(Workspace& w, const PointerInput& input) {
  gesture_ = over_axes(w, press_) ? Gesture::on_axes : Gesture::pressed;
  if (gesture_ == Gesture::pressed && w.view.interaction.placing_pivot) {
    gesture_ = Gesture::ignored;
    w.view.interaction.placing_pivot = false;
    w.view.handling.pivot = document::Pivot::point;
    w.view.handling.point = pivot_place(w, press_);
    return;
  }
  mode_ = mode_of(input);
  shape_.reset();
  selection_before_ = w.document.selection();
  if (gesture_ == Gesture::pressed && w.view.interaction.armed) return press_armed(w, input);
  if (gesture_ == Gesture::pressed && shows_mask(w)) {
    gesture_ = Gesture::painting;
    w.view.interaction.stroke.emplace(w.document);
    return paint(w, input);
  }
  again_ = input.double_click && clicked_;
  clicked_ = false;
  grabbed_ = element_under(w, press_);
  handle_ = handle_under(w, press_, is_small(w, grabbed_));
  crowded_ = is_crowded(w.document, w.view.camera, press_, sight_.of(w));
}

// Handles a press with an armed selection tool. The brush selects at once; box and lasso begin with a drag.
void Pointer::press_armed(Workspace& w, const PointerInput& input) {
  shape_ = w.view.interaction.armed;
  handle_.reset();
  grabbed_ = element_under(w, press_);
  if (shape_ != interact::SelectShape::brush) return disarm(w);
  gesture_ = shows_selectable(w) ? Gesture::brushing : Gesture::ignored;
  if (gesture_ == Gesture::ignored) return;
  w.view.interaction.brushing = mode_ == document::SelectMode::remove ? mode_ : document::SelectMode::add;
  brush_on(w, input);
}

void Pointer::move(Workspace& w, const PointerInput& input) {
  // If a key changed the element kind or removed the pressed element, the index in `grabbed_` is invalid.
  const document::ElementKind kind = w.document.selection().kind();
  const bool gone = grabbed_ && grabbed_->index >= element_count(w.document, kind);
  if (gesture_ == Gesture::pressed && (gone || kind != selection_before_.kind())) gesture_ = Gesture::ignored;
  const glm::vec2 delta = input.position - last_.position;
  if (glm::distance(input.position, press_) >= drag_threshold) {
    travelled_ = true;
    if (gesture_ == Gesture::pressed) begin_left_drag(w, input);
    if (gesture_ == Gesture::on_axes) gesture_ = Gesture::orbiting;
  }
  switch (gesture_) {
    case Gesture::moving:
    case Gesture::grabbed: transform(w, input); break;
    case Gesture::painting:
      if (delta != glm::vec2(0)) paint(w, input);
      break;
    case Gesture::boxing: w.view.interaction.box->opposite = input.position; break;
    case Gesture::lassoing: draw_on(*w.view.interaction.lasso, input.position); break;
    case Gesture::brushing:
      if (delta != glm::vec2(0)) brush_on(w, input);
      break;
    case Gesture::orbiting:
      if (delta != glm::vec2(0) && (travelled_ || button_ != right_button)) w.view.camera.orbit(delta);
      break;
    case Gesture::panning:
      if (delta != glm::vec2(0)) w.view.camera.pan(delta);
      break;
    case Gesture::zooming:
      if (delta.y != 0) w.view.camera.zoom(-0.05f * delta.y, press_);
      break;
    default: break;
  }
}

// If faces or dense vertices leave no free place to start a box, a drag from an unselected element draws a
// box. A drag from a selected element moves the selection.
bool Pointer::draws_box(const Workspace& w) const {
  if (handle_) return false;
  const document::Selection& selection = w.document.selection();
  if (!grabbed_ || mode_ != document::SelectMode::replace) return true;
  return (selection.kind() == document::ElementKind::face || crowded_) &&
         !selection.contains(grabbed_->index);
}

void Pointer::begin_left_drag(Workspace& w, const PointerInput& input) {
  if (!shape_ && !draws_box(w)) return begin_transform(w);
  if (!shape_ && !grabbed_ && w.preferences.keymap.left_orbits() && mode_ == document::SelectMode::replace) {
    gesture_ = Gesture::orbiting;
  } else if (!shows_selectable(w)) {
    gesture_ = Gesture::ignored;
  } else if (shape_ == interact::SelectShape::lasso) {
    gesture_ = Gesture::lassoing;
    w.view.interaction.lasso = interact::Lasso{{press_}, mode_};
  } else {
    gesture_ = Gesture::boxing;
    w.view.interaction.box = Interaction::Box{press_, input.position, mode_};
  }
}

// A drag of a handle uses the current tool. A drag of an element moves the selection.
void Pointer::begin_transform(Workspace& w) {
  document::Document& document = w.document;
  gesture_ = Gesture::moving;
  selection_before_ = document.selection();
  auto& view = w.view;
  if (handle_) {
    interact::Grip grip = grip_of(w);
    const double depth = view.camera.depth(glm::vec3(in_view(document, grip.anchor.center)));
    view.interaction.drag.emplace(document, std::move(grip), view.tool, *handle_, depth, press_, view.camera);
    return;
  }
  if (!document.selection().contains(grabbed_->index))
    document.changed_selection().apply(std::array{grabbed_->index}, document::SelectMode::replace);
  view.interaction.hovered = grabbed_->index;
  view.interaction.drag.emplace(document, grip_of(w), interact::Tool::move, interact::Constraint{},
                                grabbed_->depth, press_, view.camera);
}

void Pointer::transform(Workspace& w, const PointerInput& input) {
  interact::TransformDrag& drag = *w.view.interaction.drag;
  bool changed = input.position != last_.position || input.ctrl != last_.ctrl || input.backspace;
  if (input.backspace) drag.backspace();
  for (const char c : input.typed) changed |= drag.type(c);
  changed |= soften_by_wheel(w, input.wheel);
  if (changed) drag.update(w.document, {input.position, input.ctrl, input.shift}, w.view.camera);
  if (!input.enter) return;
  commit_drag(w);
  finish(w, Gesture::ignored);
}

// Records the drag and its change of the selection as one edit. If nothing moved, records only the selection.
void Pointer::commit_drag(Workspace& w) {
  document::Document& document = w.document;
  const unsigned long edits = document.history().revision();
  w.view.interaction.drag->commit(document);
  if (document.history().revision() != edits) return document.changed_history().began_with(selection_before_);
  record_selection(document, selection_before_);
}

void Pointer::brush_on(Workspace& w, const PointerInput& input) {
  const float radius = w.view.interaction.select_radius;
  w.view.interaction.cursor = input.position;
  for (const glm::vec2& at : steps_between(last_.position, input.position, 0.5f * radius))
    w.document.changed_selection().apply(
        pick_elements_in_circle(w.document, w.view.camera, at, radius, sight_.of(w)),
        *w.view.interaction.brushing);
}

void Pointer::select_inside(Workspace& w, const PointerInput& input) {
  const auto inside =
      gesture_ == Gesture::lassoing
          ? pick_elements_in_lasso(w.document, w.view.camera, w.view.interaction.lasso->line, sight_.of(w))
          : pick_elements_in_box(w.document, w.view.camera, press_, input.position, sight_.of(w));
  document::Selection selection = w.document.selection();
  selection.apply(inside, mode_);
  set_selection(w.document, std::move(selection));
}

bool Pointer::soften_by_wheel(Workspace& w, float steps) {
  document::SoftSelection& soft = w.view.handling.soft;
  const bool shapes = w.view.interaction.drag->grip().shaping.shape != interact::Shape::none;
  if (!soft.on || steps == 0 || shapes)
    return false;  // bend, twist and taper cannot change their vertices during the drag
  soft.radius = std::clamp(soft.radius * std::pow(1.1, steps), document::SoftSelection::least_radius,
                           document::SoftSelection::largest_radius);
  w.view.interaction.drag->soften(w.document, soft, mirror_of(w));
  return true;
}

void Pointer::paint(Workspace& w, const PointerInput& input) {
  auto& view = w.view;
  const document::Brush& brush = view.brush;
  for (const glm::vec2& at : steps_between(last_.position, input.position, 0.25f * brush.radius)) {
    const auto center = model_under(w, at);
    view.interaction.brush = center;
    if (!center) continue;
    const float depth = view.camera.depth(w.document.space().to_view(*center));
    const double radius = brush.radius * view.camera.per_pixel(depth) / w.document.space().scale;
    view.interaction.stroke->dab(w.document, w.frame.posed, *center, radius, input.ctrl ? 1 : brush.share);
  }
}

void Pointer::release(Workspace& w, const PointerInput& input) {
  document::Document& document = w.document;
  if (gesture_ == Gesture::moving) {
    commit_drag(w);
    w.view.options.hints = false;
  } else if (gesture_ == Gesture::painting) {
    w.view.interaction.stroke->commit(document);
  } else if (gesture_ == Gesture::boxing || gesture_ == Gesture::lassoing) {
    select_inside(w, input);
  } else if (gesture_ == Gesture::brushing) {
    record_selection(document, selection_before_);
  } else if (gesture_ == Gesture::pressed) {
    click(w);
  } else if (gesture_ == Gesture::orbiting && button_ == right_button && !travelled_) {
    ask_for_menu(w);
  } else if (gesture_ == Gesture::on_axes) {
    const auto axes = axis_widget_of(w);
    const interact::AxisBall* ball = axes ? axes->ball(press_) : nullptr;
    if (ball) {
      look_from(w.view.camera, *ball);
      frame_all(w, true);
    }
  }
  finish(w, Gesture::none);
}

// A click on a gizmo handle selects the element under the handle. Without an element, the selection stays.
void Pointer::click(Workspace& w) {
  clicked_ = !again_;
  if (std::exchange(again_, false) && w.document.model().surface) {
    const mesh::Point place = pivot_place(w, press_);
    return w.view.camera.center(w.document.space().to_view(place));
  }
  document::Selection selection = w.document.selection();
  if (grabbed_) {
    selection.apply(std::array{grabbed_->index}, mode_);
  } else if (!handle_ && mode_ == document::SelectMode::replace) {
    selection.clear();
  }
  set_selection(w.document, std::move(selection));
}

void Pointer::ask_for_menu(Workspace& w) {
  const auto hovered = w.view.interaction.hovered;
  if (hovered && !w.document.selection().contains(*hovered))
    set_selection(w.document, document::Selection(w.document.selection().kind(), std::array{*hovered}));
  w.view.interaction.menu = press_;
}

void Pointer::finish(Workspace& w, Gesture next) {
  w.view.interaction.drag.reset();
  w.view.interaction.box.reset();
  w.view.interaction.lasso.reset();
  w.view.interaction.brushing.reset();
  w.view.interaction.stroke.reset();
  gesture_ = next;
}

// Cancels the gesture. A pressed button is ignored until the user releases this button.
void Pointer::cancel(Workspace& w) {
  if (w.view.interaction.drag) w.view.interaction.drag->cancel(w.document);
  if (w.view.interaction.stroke) w.view.interaction.stroke->cancel(w.document);
  if (gesture_ != Gesture::moving && gesture_ != Gesture::brushing)
    return finish(w, Gesture::ignored);  // the selection is unchanged
  // If elements were removed during the gesture, old indices can be invalid. Then nothing is selected.
  const auto& before = selection_before_.indices();
  const bool all_there =
      before.empty() || before.back() < element_count(w.document, selection_before_.kind());
  w.document.changed_selection() =
      all_there ? selection_before_ : document::Selection(selection_before_.kind());
  finish(w, Gesture::ignored);
}

}  // namespace viete::workspace
