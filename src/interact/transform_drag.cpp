#include "interact/transform_drag.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "document/elements.h"
#include "document/record.h"
#include "interact/gizmo.h"
#include "interact/placing.h"
#include "interact/shaping.h"

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
                             const TransformDrag& drag, const document::Camera& camera,
                             const document::Viewport& viewport) {
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
    arc.push_back(glm::vec2(CursorProjection(at, camera, viewport).at()));
  }
  return arc;
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
                           const document::Camera& camera, const document::Viewport& viewport) {
  const Transform by_mouse = measured(input, camera, viewport), seen = transform_;
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

Transform TransformDrag::measured(const DragInput& input, const document::Camera& camera,
                                  const document::Viewport& viewport) {
  const glm::dvec2 cursor(input.cursor);
  if (input.slow) lag_ += slow_lag * (cursor - cursor_);
  const glm::dvec2 slowed = cursor - lag_;
  const CursorProjection projection(glm::dvec3(space_.to_view({pivot_.x, pivot_.y, pivot_.z})), camera,
                                    viewport);
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
    t.shift = move_by_mouse(slowed, projection, camera, viewport);
    if (input.snap) t.shift = snapped_shift(t.shift);
  }
  cursor_ = cursor;
  return t;
}

glm::dvec3 TransformDrag::move_by_mouse(const glm::dvec2& cursor, const CursorProjection& projection,
                                        const document::Camera& camera,
                                        const document::Viewport& viewport) const {
  glm::dvec3 moved(0);
  if (constraint_.kind == Kind::free) {
    moved = camera.plane_displacement(glm::vec2(cursor - press_), depth_, viewport);
  } else if (constraint_.kind == Kind::axis) {
    moved = (projection.along(direction(), cursor) - projection.along(direction(), press_)) * direction();
  } else {
    const auto from = projection.in_plane(direction(), camera.ray(glm::vec2(press_), viewport));
    const auto to = projection.in_plane(direction(), camera.ray(glm::vec2(cursor), viewport));
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
                       const document::Camera& camera, const document::Viewport& viewport) {
  const glm::dvec3& pivot = drag.transform().pivot;
  const glm::dvec3 center(space.to_view({pivot.x, pivot.y, pivot.z}));
  const CursorProjection projection(center, camera, viewport);
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
  guides.arc = swept(std::fmod(degrees, 360.0), projection, center, drag, camera, viewport);
  if (guides.whole_turns > 0) guides.circle = swept(360, projection, center, drag, camera, viewport);
  return guides;
}

}  // namespace viete::interact
