#include "scene/workspace/pointer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/document/elements.h"
#include "scene/document/probes.h"
#include "scene/document/selection_sets.h"
#include "scene/hand/cursor_projection.h"
#include "scene/hand/shaping.h"

namespace viete::scene {

namespace {

SelectMode mode_of(const PointerInput& input) {
  if (input.shift) return SelectMode::add;
  return input.ctrl ? SelectMode::remove : SelectMode::replace;
}

// `small`: a small element is under the cursor, which has priority over a handle nearby.
std::optional<Constraint> handle_under(const Workspace& w, const glm::vec2& cursor, bool small) {
  const auto gizmo = gizmo_of(w);
  if (!gizmo) return std::nullopt;
  const auto handle = pick_handle(*gizmo, cursor);
  return handle || small ? handle : pick_handle(*gizmo, cursor, true);
}

// Edges and faces are large: one of them is almost always near a handle.
bool is_small(const Workspace& w, const std::optional<Pick>& element) {
  const ElementKind kind = w.document.selection.kind();
  return element && (kind == ElementKind::vertex || kind == ElementKind::probe);
}

std::optional<mesh::Point> brush_under(const Workspace& w, const glm::vec2& cursor) {
  return pick_model(w.document, w.posed, w.camera.ray(cursor, w.viewport));
}

bool over_axes(const Workspace& w, const glm::vec2& cursor) {
  const auto axes = axis_widget_of(w);
  return axes && axes->contains(cursor);
}

glm::dvec3 in_view(const Document& document, const glm::dvec3& place) {
  return glm::dvec3(document.space.to_view({place.x, place.y, place.z}));
}

Anchor anchor_of(const Workspace& w) {
  return anchor_of(w.document, w.handling, mirror_of(w), w.camera);
}

// The point of an edge of the posed cage that is nearest to the ray under the cursor.
mesh::Point on_edge(const Workspace& w, std::uint32_t edge, const glm::vec2& cursor) {
  const auto& [i, j] = w.document.cage->edges[edge];
  const mesh::Point &a = w.document.pose.positions[i], &b = w.document.pose.positions[j];
  const Ray ray = w.camera.ray(cursor, w.viewport);
  const glm::dvec3 way = w.document.space.scale * vector_of(b - a);
  const glm::dvec3 normal = glm::cross(ray.direction, glm::cross(ray.direction, way));
  const double slope = glm::dot(way, normal);
  const glm::dvec3 from = ray.origin - glm::dvec3(w.document.space.to_view(a));
  return a + (slope != 0 ? std::clamp(glm::dot(from, normal) / slope, 0.0, 1.0) : 0) * (b - a);
}

mesh::Point beside_target(const Workspace& w, const glm::vec2& cursor) {
  const glm::dvec3 target(w.camera.pose().target);
  const CursorProjection projection(target, w.camera, w.viewport);
  const auto at = projection.in_plane(-glm::dvec3(w.camera.forward()), w.camera.ray(cursor, w.viewport));
  return w.document.space.to_file(at.value_or(target));
}

using Seen = std::vector<std::optional<glm::vec3>>;

void hide(Sight& sight, const Seen& points, std::span<const mesh::Triangle> triangles) {
  for (const auto& t : triangles) {
    if (points[t[0]] && points[t[1]] && points[t[2]])
      sight.hide_behind(*points[t[0]], *points[t[1]], *points[t[2]]);
  }
}

// With the drawn model and the cage's faces as occluders.
Sight sight_of(const Workspace& w) {
  Sight sight(w.camera, w.viewport);
  const Projector project(w.document.space, w.camera, w.viewport);
  Seen points;
  if (w.view.model && w.document.model.surface) {
    const mesh::Surface& model = *w.document.model.surface;
    points.reserve(model.positions.size());
    for (std::size_t v = 0; v < model.positions.size(); ++v) points.push_back(project(w.posed.at(model, v)));
    hide(sight, points, model.triangles);
  }
  if (w.document.has_cage()) {
    points.clear();
    for (const auto& p : w.document.pose.positions) points.push_back(project(p));
    // Hidden faces do not occlude.
    const auto hidden = hidden_elements(w.document, ElementKind::face);
    const mesh::Surface& cage = w.document.cage->surface;
    std::vector<mesh::Triangle> triangles;
    for (std::size_t t = 0; t < cage.triangles.size(); ++t) {
      if (!hidden[cage.triangle_polygon[t]]) triangles.push_back(cage.triangles[t]);
    }
    hide(sight, points, triangles);
  }
  return sight;
}

}  // namespace

mesh::Point pivot_place(const Workspace& w, const glm::vec2& cursor) {
  if (w.document.has_cage() && w.view.cage) {
    const auto under = [&](ElementKind kind) {
      return pick_element(w.document, kind, w.camera, w.viewport, cursor);
    };
    if (const auto vertex = under(ElementKind::vertex)) return w.document.pose.positions[vertex->index];
    if (const auto edge = under(ElementKind::edge)) return on_edge(w, edge->index, cursor);
  }
  if (const auto on_model = pick_model(w.document, w.posed, w.camera.ray(cursor, w.viewport)))
    return *on_model;
  return beside_target(w, cursor);
}

const Sight* SightCache::of(const Workspace& w) {
  if (!w.view.select_visible) return nullptr;
  const Picture now{w.camera.pose(),         w.viewport,   w.document.revisions(),  w.posed.frame,
                    w.posed.vertices.data(), w.view.model, w.document.groups.hidden};
  if (picture_ != now) {
    picture_ = now;
    sight_.emplace(sight_of(w));
  }
  return &*sight_;
}

void arm(Workspace& w, SelectShape shape) {
  const bool again = w.interaction.armed == shape;
  disarm(w);
  if (!again) w.interaction.armed = shape;
}

void disarm(Workspace& w) {
  w.interaction.armed.reset();
}

std::optional<Gizmo> gizmo_of(const Workspace& w) {
  if (!shows_selectable(w) || w.document.selection.empty()) return std::nullopt;
  if (w.document.selection.kind() == ElementKind::probe && !has_free_probes(w.document)) return std::nullopt;
  const Tool tool = w.interaction.drag ? w.interaction.drag->tool() : w.tool;
  const Anchor anchor = anchor_of(w);
  // The pivot stays during rotation and scale; a move takes the gizmo along.
  const bool turning = w.interaction.drag && w.interaction.drag->tool() != Tool::move;
  const glm::dvec3& center = turning ? w.interaction.drag->grip().anchor.center : anchor.center;
  const glm::dmat3& axes = w.interaction.drag ? w.interaction.drag->grip().anchor.axes : anchor.axes;
  return make_gizmo(tool, in_view(w.document, center), axes, w.camera, w.viewport);
}

Grip grip_of(const Workspace& w) {
  return grip_of(w.document, w.handling, mirror_of(w), w.camera);
}

std::optional<AxisWidget> axis_widget_of(const Workspace& w) {
  const bool shown = w.view.axes && w.view.panels && w.document.model.surface;
  return shown ? axis_widget(w.camera, w.viewport) : std::nullopt;
}

void Pointer::frame(Workspace& workspace, const PointerInput& input) {
  workspace.mirror.follow(workspace.document.cage, workspace.handling.mirror);
  // After a change of document or cage the running gesture is void.
  const Revisions& now = workspace.document.revisions();
  if (surfaces_ != now.surfaces || cage_ != now.cage) {
    surfaces_ = now.surfaces;
    cage_ = now.cage;
    if (active()) finish(workspace, Gesture::ignored);
  }
  if (workspace.interaction.placing_pivot && input.escape) workspace.interaction.placing_pivot = false;
  if (workspace.interaction.grab && !active()) begin_grab(workspace, input);
  if (gesture_ == Gesture::grabbed) end_grab(workspace, input);
  const bool left_gesture = active() && gesture_ != Gesture::ignored && button_ == left_button;
  if (left_gesture && (input.escape || pressed_now(input, right_button))) {
    cancel(workspace);
  } else if (!active()) {
    press(workspace, input);
  }
  if (active()) move(workspace, input);
  if (active() && gesture_ != Gesture::grabbed && !input.down[button_]) release(workspace, input);
  if (!active()) hover(workspace, input);
  const bool free = !active() || gesture_ == Gesture::brushing;
  if (free && input.over_view && input.wheel != 0) turn_wheel(workspace, input);
  last_ = input;
}

void Pointer::turn_wheel(Workspace& workspace, const PointerInput& input) {
  const float factor = std::pow(1.1f, input.wheel);
  float& select_radius = workspace.interaction.select_radius;
  if (workspace.interaction.armed == SelectShape::brush) {
    select_radius = std::clamp(select_radius * factor, least_select_radius, largest_select_radius);
  } else if (shows_mask(workspace) && input.shift) {
    const float radius = workspace.brush.radius * factor;
    workspace.brush.radius = std::clamp(radius, Brush::least_radius, Brush::largest_radius);
  } else {
    workspace.camera.zoom(input.wheel, input.position, workspace.viewport);
  }
}

std::optional<Pick> Pointer::element_under(const Workspace& w, const glm::vec2& cursor) {
  if (!shows_selectable(w)) return std::nullopt;
  return pick_element(w.document, w.camera, w.viewport, cursor, sight_.of(w));
}

// Priority under the mouse: armed tool, axis widget, gizmo, cage.
void Pointer::hover(Workspace& workspace, const PointerInput& input) {
  Interaction& interaction = workspace.interaction;
  interaction.over_axes = input.over_view && over_axes(workspace, input.position);
  const bool free = input.over_view && !interaction.over_axes;
  interaction.brush.reset();
  interaction.crowded = false;
  interaction.cursor = free ? std::optional(input.position) : std::nullopt;
  if (free && interaction.armed) {
    interaction.handle.reset(), interaction.hovered.reset();
    return;
  }
  if (free && shows_mask(workspace)) {
    interaction.handle.reset(), interaction.hovered.reset();
    interaction.brush = brush_under(workspace, input.position);
    return;
  }
  auto pick = free ? element_under(workspace, input.position) : std::nullopt;
  interaction.handle =
      free ? handle_under(workspace, input.position, is_small(workspace, pick)) : std::nullopt;
  if (interaction.handle) pick.reset();
  interaction.hovered = pick ? std::optional(pick->index) : std::nullopt;
  interaction.crowded = pick && is_crowded(workspace.document, workspace.camera, workspace.viewport,
                                           input.position, sight_.of(workspace));
}

void Pointer::press(Workspace& workspace, const PointerInput& input) {
  if (!input.over_view) return;
  for (const int button : {left_button, right_button, middle_button}) {
    if (!pressed_now(input, button)) continue;
    button_ = button;
    travelled_ = false;
    press_ = input.position;
    last_.position = input.position;
    if (button == left_button && !input.alt) return press_left(workspace, input);
    gesture_ = camera_gesture(workspace, button, input);
    return;
  }
}

Pointer::Gesture Pointer::camera_gesture(const Workspace& workspace, int button,
                                         const PointerInput& input) const {
  const Keymap& keys = workspace.preferences.keymap;
  if (keys.alt_moves_camera() && input.alt && button == middle_button) return Gesture::panning;
  if (keys.alt_moves_camera() && input.alt && button == right_button) return Gesture::zooming;
  if (keys.left_orbits() && button == right_button) return Gesture::panning;
  return input.shift ? Gesture::panning : input.ctrl ? Gesture::zooming : Gesture::orbiting;
}

// Like dragging the gizmo's center, but without a button.
void Pointer::begin_grab(Workspace& workspace, const PointerInput& input) {
  const bool wanted = !input.escape && shows_selectable(workspace) && !workspace.document.selection.empty();
  if (wanted && !input.over_view)
    return;  // requested by a panel button: starts when the pointer is in the view
  const auto [tool, shape] = *std::exchange(workspace.interaction.grab, std::nullopt);
  if (!wanted) return;
  gesture_ = Gesture::grabbed;
  button_ = left_button;
  press_ = last_.position = input.position;
  grabbed_.reset();
  handle_.reset();
  selection_before_ = workspace.document.selection;
  Grip grip = grip_of(workspace);
  if (shape != Shape::none)
    grip.shaping = shaping_of(workspace.document, shape, grip, workspace.handling.pivot == Pivot::median,
                              workspace.camera);
  if (grip.shaping.shape != shape) {
    gesture_ = Gesture::none;
    return workspace.messages.info("The selection has no two ends to " + std::string(name(shape)) +
                                   " between.");
  }
  const double depth = workspace.camera.depth(glm::vec3(in_view(workspace.document, grip.anchor.center)));
  workspace.interaction.handle.reset(), workspace.interaction.hovered.reset();
  workspace.interaction.drag.emplace(workspace.document, std::move(grip), tool, Constraint{}, depth, press_,
                                     workspace.camera);
}

void Pointer::end_grab(Workspace& workspace, const PointerInput& input) {
  if (!pressed_now(input, left_button)) return;
  workspace.interaction.drag->commit(workspace.document);
  workspace.view.hints = false;
  finish(workspace, Gesture::ignored);
}

void Pointer::press_left(Workspace& workspace, const PointerInput& input) {
  gesture_ = over_axes(workspace, press_) ? Gesture::on_axes : Gesture::pressed;
  if (gesture_ == Gesture::pressed && workspace.interaction.placing_pivot) {
    gesture_ = Gesture::ignored;
    workspace.interaction.placing_pivot = false;
    workspace.handling.pivot = Pivot::point;
    workspace.handling.point = pivot_place(workspace, press_);
    return;
  }
  mode_ = mode_of(input);
  shape_.reset();
  selection_before_ = workspace.document.selection;
  if (gesture_ == Gesture::pressed && workspace.interaction.armed) return press_armed(workspace, input);
  if (gesture_ == Gesture::pressed && shows_mask(workspace)) {
    gesture_ = Gesture::painting;
    workspace.interaction.stroke.emplace(workspace.document);
    return paint(workspace, input);
  }
  again_ = input.double_click && clicked_;
  clicked_ = false;
  grabbed_ = element_under(workspace, press_);
  handle_ = handle_under(workspace, press_, is_small(workspace, grabbed_));
  crowded_ =
      is_crowded(workspace.document, workspace.camera, workspace.viewport, press_, sight_.of(workspace));
}

// A click selects as usual; a brush starts immediately and stays armed.
void Pointer::press_armed(Workspace& workspace, const PointerInput& input) {
  shape_ = workspace.interaction.armed;
  handle_.reset();
  grabbed_ = element_under(workspace, press_);
  if (shape_ != SelectShape::brush) return disarm(workspace);
  gesture_ = shows_selectable(workspace) ? Gesture::brushing : Gesture::ignored;
  if (gesture_ == Gesture::ignored) return;
  workspace.interaction.brushing = mode_ == SelectMode::remove ? mode_ : SelectMode::add;
  brush_on(workspace, input);
}

void Pointer::move(Workspace& workspace, const PointerInput& input) {
  // The pressed element's index is valid only for its kind, which a key may have changed, and only while it
  // exists.
  const ElementKind kind = workspace.document.selection.kind();
  const bool gone = grabbed_ && grabbed_->index >= element_count(workspace.document, kind);
  if (gesture_ == Gesture::pressed && (gone || kind != selection_before_.kind())) gesture_ = Gesture::ignored;
  const glm::vec2 delta = input.position - last_.position;
  if (glm::distance(input.position, press_) >= drag_threshold) {
    travelled_ = true;
    if (gesture_ == Gesture::pressed) begin_left_drag(workspace, input);
    if (gesture_ == Gesture::on_axes) gesture_ = Gesture::orbiting;
  }
  switch (gesture_) {
    case Gesture::moving:
    case Gesture::grabbed: transform(workspace, input); break;
    case Gesture::painting:
      if (delta != glm::vec2(0)) paint(workspace, input);
      break;
    case Gesture::boxing: workspace.interaction.box->opposite = input.position; break;
    case Gesture::lassoing: draw_on(*workspace.interaction.lasso, input.position); break;
    case Gesture::brushing:
      if (delta != glm::vec2(0)) brush_on(workspace, input);
      break;
    case Gesture::orbiting:
      if (delta != glm::vec2(0) && (travelled_ || button_ != right_button)) workspace.camera.orbit(delta);
      break;
    case Gesture::panning:
      if (delta != glm::vec2(0)) workspace.camera.pan(delta, workspace.viewport);
      break;
    case Gesture::zooming:
      if (delta.y != 0) workspace.camera.zoom(-0.05f * delta.y, press_, workspace.viewport);
      break;
    default: break;
  }
}

// Faces and dense vertices cover the whole cage: if pressing an unselected one dragged it, a box could not be
// started.
bool Pointer::draws_box(const Workspace& workspace) const {
  if (handle_) return false;
  const Selection& selection = workspace.document.selection;
  if (!grabbed_ || mode_ != SelectMode::replace) return true;
  return (selection.kind() == ElementKind::face || crowded_) && !selection.contains(grabbed_->index);
}

void Pointer::begin_left_drag(Workspace& workspace, const PointerInput& input) {
  if (!shape_ && !draws_box(workspace)) return begin_transform(workspace);
  if (!shape_ && !grabbed_ && workspace.preferences.keymap.left_orbits() && mode_ == SelectMode::replace) {
    gesture_ = Gesture::orbiting;
  } else if (!shows_selectable(workspace)) {
    gesture_ = Gesture::ignored;
  } else if (shape_ == SelectShape::lasso) {
    gesture_ = Gesture::lassoing;
    workspace.interaction.lasso = Lasso{{press_}, mode_};
  } else {
    gesture_ = Gesture::boxing;
    workspace.interaction.box = Interaction::Box{press_, input.position, mode_};
  }
}

// A handle uses its tool; an element moves with its selection.
void Pointer::begin_transform(Workspace& workspace) {
  Document& document = workspace.document;
  gesture_ = Gesture::moving;
  selection_before_ = document.selection;
  if (handle_) {
    Grip grip = grip_of(workspace);
    const double depth = workspace.camera.depth(glm::vec3(in_view(document, grip.anchor.center)));
    workspace.interaction.drag.emplace(document, std::move(grip), workspace.tool, *handle_, depth, press_,
                                       workspace.camera);
    return;
  }
  if (!document.selection.contains(grabbed_->index)) {
    document.selection.apply(std::array{grabbed_->index}, SelectMode::replace);
  }
  workspace.interaction.hovered = grabbed_->index;
  workspace.interaction.drag.emplace(document, grip_of(workspace), Tool::move, Constraint{}, grabbed_->depth,
                                     press_, workspace.camera);
}

void Pointer::transform(Workspace& workspace, const PointerInput& input) {
  TransformDrag& drag = *workspace.interaction.drag;
  bool changed = input.position != last_.position || input.ctrl != last_.ctrl || input.backspace;
  if (input.backspace) drag.backspace();
  for (const char c : input.typed) changed |= drag.type(c);
  changed |= soften_by_wheel(workspace, input.wheel);
  if (changed) {
    drag.update(workspace.document, {input.position, input.ctrl, input.shift}, workspace.camera,
                workspace.viewport);
  }
  if (!input.enter) return;
  commit_drag(workspace);
  finish(workspace, Gesture::ignored);
}

// Dragging an unselected element has selected it: that is part of the move, or the whole edit if nothing
// moved.
void Pointer::commit_drag(Workspace& workspace) {
  Document& document = workspace.document;
  const unsigned long edits = document.history.revision();
  workspace.interaction.drag->commit(document);
  if (document.history.revision() != edits) return document.history.began_with(selection_before_);
  record_selection(document, selection_before_);
}

// Interpolates in steps of half the radius, so that fast strokes have no gaps.
void Pointer::brush_on(Workspace& w, const PointerInput& input) {
  const float radius = w.interaction.select_radius;
  const int steps =
      std::max(1, static_cast<int>(std::ceil(2 * glm::distance(last_.position, input.position) / radius)));
  w.interaction.cursor = input.position;
  for (int step = 1; step <= steps; ++step) {
    const float t = static_cast<float>(step) / static_cast<float>(steps);
    const auto within = pick_elements_in_circle(
        w.document, w.camera, w.viewport, glm::mix(last_.position, input.position, t), radius, sight_.of(w));
    w.document.selection.apply(within, *w.interaction.brushing);
  }
}

// For a finished box or lasso.
void Pointer::select_inside(Workspace& w, const PointerInput& input) {
  const auto inside =
      gesture_ == Gesture::lassoing
          ? pick_elements_in_lasso(w.document, w.camera, w.viewport, w.interaction.lasso->line, sight_.of(w))
          : pick_elements_in_box(w.document, w.camera, w.viewport, press_, input.position, sight_.of(w));
  Selection selection = w.document.selection;
  selection.apply(inside, mode_);
  set_selection(w.document, std::move(selection));
}

bool Pointer::soften_by_wheel(Workspace& workspace, float steps) {
  SoftSelection& soft = workspace.handling.soft;
  const bool shapes = workspace.interaction.drag->grip().shaping.shape != Shape::none;
  if (!soft.on || steps == 0 || shapes) return false;  // shapes depend on the original vertices
  soft.radius = std::clamp(soft.radius * std::pow(1.1, steps), SoftSelection::least_radius,
                           SoftSelection::largest_radius);
  workspace.interaction.drag->soften(workspace.document, soft, mirror_of(workspace));
  return true;
}

// Interpolates in steps of a quarter of the radius, so that fast strokes have no gaps.
void Pointer::paint(Workspace& workspace, const PointerInput& input) {
  const Brush& brush = workspace.brush;
  const float way = glm::distance(last_.position, input.position);
  const int steps = std::max(1, static_cast<int>(std::ceil(4 * way / brush.radius)));
  for (int step = 1; step <= steps; ++step) {
    const float t = static_cast<float>(step) / static_cast<float>(steps);
    const auto center = brush_under(workspace, glm::mix(last_.position, input.position, t));
    workspace.interaction.brush = center;
    if (!center) continue;
    const float depth = workspace.camera.depth(workspace.document.space.to_view(*center));
    const double radius =
        brush.radius * workspace.camera.per_pixel(depth, workspace.viewport) / workspace.document.space.scale;
    workspace.interaction.stroke->dab(workspace.document, workspace.posed, *center, radius,
                                      input.ctrl ? 1 : brush.share);
  }
}

void Pointer::release(Workspace& workspace, const PointerInput& input) {
  Document& document = workspace.document;
  if (gesture_ == Gesture::moving) {
    commit_drag(workspace);
    workspace.view.hints = false;
  } else if (gesture_ == Gesture::painting) {
    workspace.interaction.stroke->commit(document);
  } else if (gesture_ == Gesture::boxing || gesture_ == Gesture::lassoing) {
    select_inside(workspace, input);
  } else if (gesture_ == Gesture::brushing) {
    record_selection(document, selection_before_);
  } else if (gesture_ == Gesture::pressed) {
    click(workspace);
  } else if (gesture_ == Gesture::orbiting && button_ == right_button && !travelled_) {
    ask_for_menu(workspace);
  } else if (gesture_ == Gesture::on_axes) {
    const auto axes = axis_widget_of(workspace);
    const AxisBall* ball = axes ? axes->ball(press_) : nullptr;
    if (ball) look_from(workspace.camera, *ball), frame_all(workspace, true);
  }
  finish(workspace, Gesture::none);
}

// A click on a gizmo handle selects the element below it. Without one, the selection is unchanged.
void Pointer::click(Workspace& workspace) {
  clicked_ = !again_;
  if (std::exchange(again_, false) && workspace.document.model.surface) {
    const mesh::Point place = pivot_place(workspace, press_);
    return workspace.camera.center(workspace.document.space.to_view(place));
  }
  Selection selection = workspace.document.selection;
  if (grabbed_) {
    selection.apply(std::array{grabbed_->index}, mode_);
  } else if (!handle_ && mode_ == SelectMode::replace) {
    selection.clear();
  }
  set_selection(workspace.document, std::move(selection));
}

// Requests the context menu of the selection; selects the element under the cursor first if it is unselected.
void Pointer::ask_for_menu(Workspace& workspace) {
  const auto hovered = workspace.interaction.hovered;
  if (hovered && !workspace.document.selection.contains(*hovered)) {
    Selection selection(workspace.document.selection.kind());
    selection.apply(std::array{*hovered}, SelectMode::replace);
    set_selection(workspace.document, std::move(selection));
  }
  workspace.interaction.menu = press_;
}

void Pointer::finish(Workspace& workspace, Gesture next) {
  workspace.interaction.drag.reset();
  workspace.interaction.box.reset();
  workspace.interaction.lasso.reset();
  workspace.interaction.brushing.reset();
  workspace.interaction.stroke.reset();
  gesture_ = next;
}

// The button is ignored until it is released.
void Pointer::cancel(Workspace& workspace) {
  if (workspace.interaction.drag) workspace.interaction.drag->cancel(workspace.document);
  if (workspace.interaction.stroke) {
    workspace.interaction.stroke->cancel(workspace.document);
    return finish(workspace, Gesture::ignored);
  }
  if (gesture_ != Gesture::moving && gesture_ != Gesture::brushing)
    return finish(workspace, Gesture::ignored);  // nothing was selected yet
  // Elements removed in the meantime are not selected again.
  const auto& before = selection_before_.indices();
  const bool all_there =
      before.empty() || before.back() < element_count(workspace.document, selection_before_.kind());
  workspace.document.selection = all_there ? selection_before_ : Selection(selection_before_.kind());
  finish(workspace, Gesture::ignored);
}

}  // namespace viete::scene
