#include "interact/transform_drag.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.h"
#include "document/elements.h"
#include "document/range.h"
#include "document/space.h"
#include "interact/gizmo.h"
#include "pose/branches.h"
#include "pose/cage_state.h"
#include "pose/maps.h"
#include "sym3/affine.h"

namespace viete::interact {

namespace {

using Kind = Constraint::Kind;

constexpr double slow_lag = 0.9;           // the fraction of the movement that slow mode ignores
constexpr double turn_snap = 15;           // in degrees
constexpr double scale_snaps = 10;         // steps per unit of the factor
constexpr double move_snaps = 10;          // steps per grid cell
constexpr double even_scale_pixels = 120;  // the mouse movement that scales by 2
constexpr double shortest_grip = 40;       // in pixels; limits the speed of scaling close to the pivot
constexpr double shape_pixels_per_degree = 2, whole_share_pixels = 200;
constexpr double degrees_of_radian = 57.29577951308232;

// Rounds to a multiple of 1 / per_unit. The division gives exactly the decimal number that a user would type.
double snapped(double value, double per_unit) {
  return std::round(value * per_unit) / per_unit;
}

// Prints no minus sign before zero.
std::string print(const char* format, double value) {
  const std::string text = base::formatted(format, value);
  const bool zero = text.find_first_not_of("-0.") == std::string::npos;
  return zero && text[0] == '-' ? text.substr(1) : text;
}

std::string length_text(double value, double cell) {
  const double decimals = 2 - std::floor(std::log10(cell));
  if (!(decimals >= 0 && decimals <= 9)) return print("%.3g", value);
  return print(("%." + std::to_string(static_cast<int>(decimals)) + "f").c_str(), value);
}

bool follows(const TransformDrag& drag, int axis) {
  const Constraint& c = drag.constraint();
  if (drag.tool() == Tool::rotate || c.kind == Kind::free) return false;
  return (c.kind == Kind::axis) == (axis == c.axis);
}

// Returns the arc from the pressed point to its rotated position, in logical pixels.
std::vector<glm::vec2> swept(double degrees, const CursorProjection& projection, const glm::dvec3& center,
                             const TransformDrag& drag, const document::Camera& camera) {
  const Transform& t = drag.transform();
  const auto from = projection.angle(t.axis, glm::dvec2(drag.press()));
  if (!from) return {};
  const double radius =
      projection.per_pixel() * (drag.constraint().kind == Kind::free ? gizmo_view_ring : gizmo_radius);
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(degrees) / 4)));
  const PlaneAxes across = plane_axes(t.axis);
  std::vector<glm::vec2> arc;
  for (int i = 0; i <= steps; ++i) {
    const double angle = *from + degrees * i / steps * 0.017453292519943295;
    const glm::dvec3 at = center + radius * (std::cos(angle) * across.u + std::sin(angle) * across.v);
    arc.push_back(glm::vec2(CursorProjection(at, camera).at()));
  }
  return arc;
}

constexpr double turn_rounding = 1e-6;
constexpr double largest_step = 30;  // in degrees; small enough to count whole turns reliably

struct Motion {
  document::Document& document;
  const pose::Pose& before;
  const Grip& grip;
  Transform transform;

  void show(double degrees) {
    transform.degrees = degrees;
    move_gripped(transform, grip, before.positions, document.changed_pose().positions);
  }

  // Rotates in small steps, and updates the turns of the pose after each step.
  void follow(double from, double to) {
    const int steps = static_cast<int>(std::ceil(std::abs(to - from) / largest_step));
    pose::CageState cage(document.cage(), pose::Elements::face, pose::Blend::srl);
    for (int i = 1; i <= steps; ++i) {
      show(from + (to - from) * i / steps);
      cage.set_pose(document.pose());
      document.changed_pose().turns = cage.report().turns;
    }
  }

  // Adds `count` whole turns. Rotates only once, and multiplies the change of the pose's turns by |count|.
  void follow_whole(double from, int count) {
    if (count == 0) return;
    auto& turns = document.changed_pose().turns;
    turns.resize(document.cage()->roots.size(), {0, 0, 0});
    const auto start = turns;
    follow(from, from + std::copysign(360, count));
    for (std::size_t part = 0; part < turns.size(); ++part) {
      turns[part] = start[part] + std::abs(count) * (turns[part] - start[part]);
    }
  }
};

// Returns the rotation axis of each part of the cage; (0, 0, 0) for a part that does not rotate rigidly.
std::vector<mesh::Vec3> axes_of_parts(const pose::Cage& cage, const Grip& grip, const glm::dvec3& axis) {
  const mesh::Vec3 own{axis.x, axis.y, axis.z}, other = -1.0 * document::reflected_direction(grip.plane, own),
                                                none{};
  std::vector<mesh::Vec3> of_vertex(cage.surface.positions.size()), of_part(cage.roots.size());
  for (const Gripped& g : grip.vertices)
    if (g.share == 1 && g.side != Gripped::Side::plane)
      of_vertex[g.vertex] = g.side == Gripped::Side::own ? own : other;
  std::vector<bool> seen(cage.roots.size());
  for (std::size_t e = 0; e < cage.element_count(); ++e) {
    const auto part = cage.parts[e];
    if (part >= of_part.size()) continue;
    for (const auto v : cage.elements.triangles[e]) {
      if (v >= of_vertex.size()) continue;  // the center of a polygon
      const bool first = !seen[part];
      seen[part] = true;
      of_part[part] = first || of_part[part] == of_vertex[v] ? of_vertex[v] : none;
    }
  }
  return of_part;
}

// `rotation` is a rotation vector. Returns its angle about `axis`, in radians in [-pi, pi].
double twist(const mesh::Vec3& rotation, const mesh::Vec3& axis) {
  const double half = mesh::norm(rotation) / 2;
  return half == 0 ? 0
                   : 2 * std::atan2(std::sin(half) * mesh::dot(rotation, axis) / (2 * half), std::cos(half));
}

std::vector<mesh::Vec3> least_turns(const document::Document& document,
                                    const std::vector<mesh::Point>& positions) {
  pose::CageState state(document.cage(), pose::Elements::face, pose::Blend::srl);
  state.set_pose({positions, {}});
  return state.report().turns;
}

// `turn` is a rotation vector with whole turns; `least` is the same rotation without whole turns. If the
// whole turns are about `axis`, returns their number. Otherwise returns nullopt.
std::optional<double> turns_about(const mesh::Vec3& axis, const mesh::Vec3& turn, const mesh::Vec3& least) {
  constexpr double same_axis = 1e-6;
  const double count = pose::whole_turns(turn, least), along = mesh::dot(turn, axis);
  if (count == 0) return 0;
  if (mesh::norm(turn - along * axis) > same_axis * mesh::norm(turn)) return std::nullopt;
  return std::copysign(count, along);
}

bool is_in_range(const document::Document& document, const Grip& grip) {
  const pose::Pose& pose = document.pose();
  return mesh::bounds(pose.positions).diagonal() <= document::most_drawn &&
         std::all_of(
             grip.vertices.begin(), grip.vertices.end(),
             [&](const Gripped& g) { return is_in_reach(document.space(), pose.positions[g.vertex]); }) &&
         std::all_of(pose.turns.begin(), pose.turns.end(),
                     [](const auto& turn) { return mesh::norm(turn) <= document::largest_turn; });
}

pose::ProbePose moved(const pose::Probe& probe, const document::Carried& carried, const Transform& t) {
  pose::ProbePose result = probe.pose;
  if (!probe.pin) {
    if (t.factors != glm::dvec3(1)) result = pose::scaled(result, document::point_of(t.factors));
    if (t.degrees != 0)
      result = pose::turned(result, document::point_of(t.axis), t.degrees / 180 * std::acos(-1.0));
  }
  const mesh::Point from = carried.place + pose::times(carried.map, probe.pose.move);
  const mesh::Point to = PointMotion(t)(from, t.pivot);
  result.move = probe.pose.move + pose::times(sym3::inverse({carried.map, {}}).linear, to - from);
  return result;
}

bool in_range(const document::Document& document, std::size_t i) {
  const pose::ProbePose& pose = document.probes().all[i].pose;
  return is_in_reach(document.space(), probe_center(document, i)) &&
         mesh::norm(pose.turn) <= document::largest_turn && document::is_probe_stretch(pose.stretch);
}

// After a rotation from the pose in `before`, sets the exact whole turns of each part of the cage that
// rotated rigidly. A part stores whole turns about one axis only. New turns about another axis replace the
// stored turns.
void count_whole_turns(document::Document& document, const document::DocumentState& before, const Grip& grip,
                       const Transform& t) {
  if (t.degrees == 0 || !document.has_cage() || grip.shaping.shape != Shape::none) return;
  const auto axes = axes_of_parts(*document.cage(), grip, t.axis);
  if (std::ranges::all_of(axes, [](const mesh::Vec3& axis) { return axis == mesh::Vec3{}; })) return;
  const auto from = least_turns(document, before.pose.positions);
  const auto to = least_turns(document, document.pose().positions);
  auto& turns = document.changed_pose().turns;
  turns.resize(axes.size(), {0, 0, 0});
  for (std::size_t part = 0; part < axes.size(); ++part) {
    const mesh::Vec3& axis = axes[part];
    if (axis == mesh::Vec3{}) continue;
    const bool known = part < before.pose.turns.size();
    const auto had = known ? turns_about(axis, before.pose.turns[part], from[part]) : 0;
    const double turned_by = twist(from[part], axis) + glm::radians(t.degrees) - twist(to[part], axis);
    const double made = std::round(turned_by / (2 * std::numbers::pi));
    if (made == 0 && (!had || *had == 0)) continue;
    const double count = had.value_or(0) + made;
    const mesh::Vec3 turned = count == 0 ? to[part] : pose::with_whole_turns(axis, count, to[part]);
    if (mesh::norm(turned - turns[part]) > turn_rounding * (1 + mesh::norm(turned))) turns[part] = turned;
  }
}

// Transforms the selected probes. If the result is out of range, changes nothing and returns false.
bool place_probes(document::Document& document, const document::DocumentState& before,
                  const Transform& transform) {
  bool fits = true;
  pose::Probes& probes = document.changed_probes();
  for (const auto i : before.selection.indices()) {
    pose::Probe& probe = probes.all[i];
    if (probe.locked) continue;
    probe.pose = moved(before.probes.all[i], carried_probe(document, i), transform);
    fits &= in_range(document, i);
  }
  if (!fits) probes = before.probes;
  return fits;
}

// Returns the name of the edit in the history, such as "rotate 3 faces".
std::string edit_label(Tool tool, const document::Selection& selection) {
  const std::string verb = tool == Tool::rotate ? "rotate" : tool == Tool::scale ? "scale" : "move";
  return verb + ' ' + counted(selection.kind(), selection.size());
}

}  // namespace

TransformDrag::TransformDrag(const document::Document& document, Grip grip, Tool tool, Constraint constraint,
                             double depth, const glm::vec2& cursor, const document::Camera& camera)
    : before_(document.state()),
      grip_(std::move(grip)),
      vertices_(vertices_of(grip_)),
      space_(document.space()),
      tool_(tool),
      constraint_(constraint),
      view_hinge_(grip_.shaping.hinge),
      pivot_(grip_.anchor.center),
      view_axis_(-camera.forward()),
      depth_(depth),
      press_(cursor),
      cursor_(cursor) {
  transform_ = still();
}

Transform TransformDrag::still() const {
  Transform t;
  t.pivot = pivot_;
  t.axes = grip_.anchor.axes;
  if (grip_.shaping.shape == Shape::taper) t.amount = 1;
  if (grip_.shaping.shape == Shape::bend) {
    t.pivot = grip_.shaping.from;
    t.axis = grip_.shaping.hinge;
  }
  return t;
}

void TransformDrag::update(document::Document& document, const DragInput& input,
                           const document::Camera& camera) {
  const Transform by_mouse = measured(input, camera), seen = transform_;
  pulled_ = by_mouse.shift;
  const auto value = entry_.value();
  transform_ = value ? typed(*value) : by_mouse;
  const bool same_axis = transform_.axis == seen.axis;
  if (!same_axis) document.changed_pose().turns = before_.pose.turns;
  in_range_ = place(document, before_, grip_, transform_, same_axis && in_range_ ? seen.degrees : 0);
}

bool TransformDrag::type(char c) {
  const char lower = static_cast<char>(c | 0x20);
  const bool axis = lower >= 'x' && lower <= 'z';
  if (axis && grip_.shaping.shape == Shape::bend) {
    bend_about(lower - 'x');
    return true;
  }
  if (!axis || grip_.shaping.shape != Shape::none) return entry_.type(c);
  const Constraint wanted{c == lower ? Kind::axis : Kind::plane, lower - 'x'};
  // A rotation has no plane: uses the normal of the plane as axis.
  const Constraint fitting = tool_ == Tool::rotate ? Constraint{Kind::axis, wanted.axis} : wanted;
  constrain(fitting == constraint_ ? Constraint{} : fitting);
  return true;
}

void TransformDrag::constrain(const Constraint& constraint) {
  constraint_ = constraint;
  turned_ = turn_lag_ = 0;
}

// If the axis is already set, changes back to bending in the view plane.
void TransformDrag::bend_about(int axis) {
  const Constraint wanted{Kind::axis, axis};
  const bool again = wanted == constraint_;
  const auto hinge = again ? view_hinge_ : hinge_near(grip_.shaping, grip_.anchor.axes[axis]);
  unbendable_axis_ = hinge ? std::nullopt : std::optional(axis);
  if (!hinge) return;
  grip_.shaping.hinge = *hinge;
  constrain(again ? Constraint{} : wanted);
}

glm::dvec3 TransformDrag::direction() const {
  if (constraint_.kind == Kind::free) return view_axis_;
  return grip_.anchor.axes[constraint_.axis];
}

glm::dvec3 TransformDrag::snapped_shift(const glm::dvec3& shift) const {
  const double per_unit = move_snaps / document::grid_cell(space_.diagonal());
  glm::dvec3 parts = glm::transpose(grip_.anchor.axes) * shift;
  for (int i = 0; i < 3; ++i) parts[i] = snapped(parts[i], per_unit);
  return grip_.anchor.axes * parts;
}

// Returns the amount for a horizontal motion. A motion to the right increases the amount.
double TransformDrag::amount_by_way(double pixels) const {
  switch (grip_.shaping.shape) {
    case Shape::bend:
    case Shape::twist: return pixels / shape_pixels_per_degree;
    case Shape::taper: return 1 + pixels / even_scale_pixels;
    default: return pixels / whole_share_pixels;
  }
}

Transform TransformDrag::shaped_by(double amount, bool snap) const {
  Transform t = still();
  if (is_angle(grip_.shaping.shape)) {
    t.degrees = snap ? turn_snap * std::round(amount / turn_snap) : amount;
  } else {
    t.amount = snap ? snapped(amount, scale_snaps) : amount;
  }
  return t;
}

Transform TransformDrag::measured(const DragInput& input, const document::Camera& camera) {
  const glm::dvec2 cursor(input.cursor);
  if (input.slow) lag_ += slow_lag * (cursor - cursor_);
  const glm::dvec2 slowed = cursor - lag_;
  const CursorProjection projection(glm::dvec3(space_.to_view({pivot_.x, pivot_.y, pivot_.z})), camera);
  Transform t = still();
  if (grip_.shaping.shape != Shape::none) {
    t = shaped_by(amount_by_way(slowed.x - press_.x), input.snap);
  } else if (tool_ == Tool::rotate) {
    t.axis = direction();
    t.degrees = degrees_of_radian * turn_by_mouse(input, projection);
    if (input.snap) t.degrees = turn_snap * std::round(t.degrees / turn_snap);
  } else if (tool_ == Tool::scale) {
    t.factors = scale_by_mouse(slowed, projection);
    for (int i = 0; i < 3 && input.snap; ++i) t.factors[i] = snapped(t.factors[i], scale_snaps);
  } else {
    t.shift = move_by_mouse(slowed, projection, camera);
    if (input.snap) t.shift = snapped_shift(t.shift);
  }
  cursor_ = cursor;
  return t;
}

glm::dvec3 TransformDrag::move_by_mouse(const glm::dvec2& cursor, const CursorProjection& projection,
                                        const document::Camera& camera) const {
  glm::dvec3 moved(0);
  if (constraint_.kind == Kind::free) {
    moved = camera.plane_displacement(glm::vec2(cursor - press_), depth_);
  } else if (constraint_.kind == Kind::axis) {
    moved = (projection.along(direction(), cursor) - projection.along(direction(), press_)) * direction();
  } else {
    const auto from = projection.in_plane(direction(), camera.ray(glm::vec2(press_)));
    const auto to = projection.in_plane(direction(), camera.ray(glm::vec2(cursor)));
    if (!from || !to) return pulled_;
    moved = *to - *from;
    moved -= glm::dot(moved, direction()) * direction();
  }
  return moved / space_.scale;
}

// The cursor's angle is known only up to whole turns. Chooses the value nearest to the previous angle.
double TransformDrag::turn_by_mouse(const DragInput& input, const CursorProjection& projection) {
  const auto now = projection.angle(direction(), input.cursor), then = projection.angle(direction(), press_);
  double turned = 0;
  if (now && then) {
    constexpr double turn = 2 * 3.14159265358979323846;
    turned = turned_ + std::remainder(*now - *then - turned_, turn);
  } else {
    turned = projection.edge_on_angle(direction(), glm::dvec2(input.cursor) - press_, gizmo_radius);
  }
  if (input.slow) turn_lag_ += slow_lag * (turned - turned_);
  turned_ = turned;
  return turned_ - turn_lag_;
}

// The mouse direction that increases the factor is: for an axis, the axis on screen; for a plane, away from
// the pivot; for a uniform scale, to the right and up.
glm::dvec3 TransformDrag::scale_by_mouse(const glm::dvec2& cursor, const CursorProjection& projection) const {
  if (constraint_.kind == Kind::free) {
    const glm::dvec2 moved = cursor - press_;
    return factors(1 + (moved.x - moved.y) / even_scale_pixels);
  }
  glm::dvec2 outward =
      constraint_.kind == Kind::axis ? projection.motion(direction()) : press_ - projection.at();
  const double length = glm::length(outward);
  if (!(length > 0)) return factors(1);
  outward /= length;
  const double grip = glm::dot(press_ - projection.at(), outward);
  const double moved = glm::dot(cursor - press_, outward);
  return factors(1 + moved / std::max(grip, shortest_grip));
}

glm::dvec3 TransformDrag::factors(double value) const {
  glm::dvec3 factors(constraint_.kind == Kind::axis ? 1.0 : value);
  if (constraint_.kind != Kind::free)
    factors[constraint_.axis] = constraint_.kind == Kind::axis ? value : 1.0;
  return factors;
}

Transform TransformDrag::typed(double value) const {
  Transform t = still();
  if (is_angle(grip_.shaping.shape)) {
    t.degrees = std::clamp(value, -most_degrees, most_degrees);
  } else if (grip_.shaping.shape != Shape::none) {
    t.amount = grip_.shaping.displacements.empty() ? value : value / 100;
  } else if (tool_ == Tool::rotate) {
    t.axis = direction();
    t.degrees = std::clamp(value, -most_degrees, most_degrees);
  } else if (tool_ == Tool::scale) {
    t.factors = factors(value);
  } else if (constraint_.kind == Kind::axis) {
    t.shift = value * direction();
  } else {
    // Moves by the typed distance in the direction of the mouse movement.
    const double length = glm::length(pulled_);
    if (length > 0) t.shift = value / length * pulled_;
  }
  return t;
}

void TransformDrag::soften(document::Document& document, const document::SoftSelection& soft,
                           const document::Mirror* mirror) {
  document.changed_pose() = before_.pose;
  grip_.vertices = gripped(document, soft, mirror);
  vertices_ = vertices_of(grip_);
  ++softened_;
  transform_.degrees = 0;  // the document has the pose at the press again
}

void TransformDrag::commit(document::Document& document) const {
  if (!in_range_ || (!moved_since(document, before_) && transform_.degrees == 0)) return;
  count_whole_turns(document, before_, grip_, transform_);
  document.changed_history().record(label(), before_);
}

std::string TransformDrag::label() const {
  if (grip_.shaping.shape == Shape::none) return edit_label(tool_, before_.selection);
  return std::string(name(grip_.shaping.shape)) + ' ' +
         counted(before_.selection.kind(), before_.selection.size());
}

void TransformDrag::cancel(document::Document& document) const {
  document.changed_pose() = before_.pose;
  document.changed_probes() = before_.probes;
  document.changed_library() = before_.library;
  document.put_shape(before_.shape);
  document.changed_selection() = before_.selection;
}

std::string TransformDrag::shaped_amount() const {
  if (is_angle(grip_.shaping.shape)) return print("%.1f", transform_.degrees) + "\u00b0";
  if (grip_.shaping.displacements.empty()) return print("%.2f", transform_.amount);
  return print("%.0f %%", 100 * transform_.amount);
}

std::string TransformDrag::amounts() const {
  if (tool_ == Tool::rotate) return print("%.1f", transform_.degrees) + "\u00b0";
  const bool scaling = tool_ == Tool::scale;
  if (scaling && constraint_.kind == Kind::free) return print("%.2f", transform_.factors.x);
  const double cell = document::grid_cell(space_.diagonal());
  const glm::dvec3 shift = glm::transpose(grip_.anchor.axes) * transform_.shift;
  std::string text;
  for (int i = 0; i < 3; ++i) {
    const bool used =
        constraint_.kind == Kind::free || (constraint_.kind == Kind::axis) == (i == constraint_.axis);
    if (!used) continue;
    const double value = scaling ? transform_.factors[i] : shift[i];
    text += (text.empty() ? "" : "   ") + std::string(1, static_cast<char>('X' + i)) + ' ' +
            (scaling ? print("%.2f", value) : length_text(value, cell));
  }
  return text;
}

// Returns text such as "X " for an axis or "XZ " for a plane. Without a constraint, returns an empty text.
std::string TransformDrag::axis_names() const {
  std::string names;
  for (int i = 0; i < 3; ++i) {
    if (constraint_.kind != Kind::free && (constraint_.kind == Kind::axis) == (i == constraint_.axis))
      names += static_cast<char>('X' + i);
  }
  return names.empty() ? "" : names + ' ';
}

std::string TransformDrag::readout() const {
  const std::string beyond = in_range_ ? "" : "   too far";
  if (grip_.shaping.shape != Shape::none) {
    std::string word(name(grip_.shaping.shape));
    word[0] = static_cast<char>(word[0] - 'a' + 'A');
    const std::string refused =
        unbendable_axis_ ? std::string("   cannot bend about ") + static_cast<char>('X' + *unbendable_axis_)
                         : "";
    return word + ' ' + axis_names() + (entry_.empty() ? shaped_amount() : entry_.text() + '_') + refused +
           beyond;
  }
  if (!entry_.empty()) return axis_names() + entry_.text() + '_' + beyond;
  return (tool_ == Tool::rotate ? axis_names() : "") + amounts() + beyond;
}

DragGuides drag_guides(const TransformDrag& drag, const document::Space& space,
                       const document::Camera& camera) {
  const glm::dvec3& pivot = drag.transform().pivot;
  const glm::dvec3 center(space.to_view({pivot.x, pivot.y, pivot.z}));
  const CursorProjection projection(center, camera);
  DragGuides guides;
  guides.start = glm::vec2(projection.at());
  for (int axis = 0; axis < 3; ++axis) {
    const glm::dvec3& direction = drag.grip().anchor.axes[axis];
    const glm::dvec2 motion = projection.motion(direction);
    if (!follows(drag, axis) || !(glm::length(motion) * projection.per_pixel() > 0.02)) continue;
    guides.axes.push_back(axis);
    guides.axis_directions.push_back(glm::vec2(glm::normalize(motion)));
  }
  if (drag.tool() != Tool::rotate) return guides;
  const double degrees = drag.transform().degrees;
  guides.whole_turns = static_cast<int>(std::min(std::abs(degrees) / 360, 1e6));
  guides.arc = swept(std::fmod(degrees, 360.0), projection, center, drag, camera);
  if (guides.whole_turns > 0) guides.circle = swept(360, projection, center, drag, camera);
  return guides;
}

bool place(document::Document& document, const document::DocumentState& snapshot, const Grip& grip,
           const Transform& transform, double degrees_seen) {
  if (snapshot.selection.kind() == document::ElementKind::probe)
    return place_probes(document, snapshot, transform);
  const pose::Pose& before = snapshot.pose;
  Motion motion{document, before, grip, transform};
  const double jump = transform.degrees - degrees_seen;
  if (std::abs(jump) > largest_step) {
    const int whole = static_cast<int>(jump / 360);
    motion.follow_whole(degrees_seen, whole);
    motion.follow(degrees_seen + 360.0 * whole, transform.degrees);
  }
  motion.show(transform.degrees);
  if (is_in_range(document, grip)) return true;
  document.changed_pose() = before;
  return false;
}

bool transform_selection(document::Document& document, Tool tool, const Grip& grip,
                         const Transform& transform) {
  const document::DocumentState before = document.state();
  Transform bounded = transform;
  bounded.degrees = std::clamp(transform.degrees, -most_degrees, most_degrees);
  if (!place(document, before, grip, bounded, 0)) return false;
  count_whole_turns(document, before, grip, bounded);
  if (moved_since(document, before) || transform.degrees != 0)
    document.changed_history().record(edit_label(tool, document.selection()), before);
  return true;
}

}  // namespace viete::interact
