#include "interact/gizmo.h"

#include <algorithm>
#include <cmath>

#include "interact/cursor_projection.h"

namespace viete::interact {

namespace {

using Kind = Constraint::Kind;

constexpr float arm_begin = 16, plane_begin = 24, plane_end = 42;  // pixels from the center along the axes
constexpr int ring_points = 96;
constexpr float faintest = 0.25f;  // handles with a lower opacity cannot be hit

float smooth(float low, float high, double x) {
  const float t = std::clamp((static_cast<float>(x) - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

// Projects offsets from the center to the screen. Offsets are in pixels at the center's depth.
struct Layout {
  const glm::dvec3& center;
  const glm::dmat3& axes;
  const document::Camera& camera;
  CursorProjection projection{center, camera};

  const glm::dvec3& unit(int axis) const { return axes[axis % 3]; }

  glm::vec2 at(const glm::dvec3& pixels) const {
    return glm::vec2(CursorProjection(center + projection.per_pixel() * pixels, camera).at());
  }
};

Gizmo::Arm arm(const Layout& layout, int axis) {
  const glm::dvec3 a = layout.unit(axis);
  const double seen = std::sqrt(std::max(0.0, 1 - std::pow(glm::dot(a, layout.projection.to_eye()), 2)));
  const auto at = [&](float pixels) { return layout.at(double(pixels) * a); };
  return {at(arm_begin), at(gizmo_radius), at(gizmo_radius + gizmo_head), smooth(0.12f, 0.3f, seen)};
}

Gizmo::Plane plane(const Layout& layout, int axis) {
  const glm::dvec3 u = layout.unit(axis + 1), v = layout.unit(axis + 2);
  const auto at = [&](double a, double b) { return layout.at(a * u + b * v); };
  const double seen = std::abs(glm::dot(layout.unit(axis), layout.projection.to_eye()));
  return {{at(plane_begin, plane_begin), at(plane_end, plane_begin), at(plane_end, plane_end),
           at(plane_begin, plane_end)},
          smooth(0.12f, 0.3f, seen)};
}

std::vector<Gizmo::RingPoint> ring(const Layout& layout, int axis) {
  // If the ring faces the viewer, all points count as front.
  const bool faces = std::abs(glm::dot(layout.unit(axis), layout.projection.to_eye())) > 0.94;
  std::vector<Gizmo::RingPoint> points;
  for (int i = 0; i < ring_points; ++i) {
    const double angle = 6.283185307179586 * i / ring_points;
    const glm::dvec3 d = std::cos(angle) * layout.unit(axis + 1) + std::sin(angle) * layout.unit(axis + 2);
    points.push_back(
        {layout.at(double(gizmo_radius) * d), faces || glm::dot(d, layout.projection.to_eye()) > -0.03});
  }
  return points;
}

float side(const glm::vec2& a, const glm::vec2& b, const glm::vec2& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

bool inside(const std::array<glm::vec2, 4>& corners, const glm::vec2& p) {
  int positive = 0;
  for (int i = 0; i < 4; ++i) positive += side(corners[i], corners[(i + 1) % 4], p) > 0;
  return positive == 0 || positive == 4;
}

// Returns the distance of p to the near side of the ring if `front`, otherwise to the far side.
float distance_to_ring(const std::vector<Gizmo::RingPoint>& ring, const glm::vec2& p, bool front = true) {
  float nearest = 1e9f;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if (a.front == front && b.front == front) nearest = std::min(nearest, distance_to_segment(p, a.at, b.at));
  }
  return nearest;
}

template <class Distance>
std::optional<Constraint> nearest_axis(float tolerance, Distance distance) {
  float nearest = tolerance;
  std::optional<Constraint> best;
  for (int axis = 0; axis < 3; ++axis) {
    const float d = distance(axis);
    if (d <= nearest) {
      nearest = d;
      best = Constraint{Kind::axis, axis};
    }
  }
  return best;
}

std::optional<Constraint> pick_ring(const Gizmo& gizmo, const glm::vec2& cursor, bool reach) {
  const float tolerance = reach ? gizmo_reach : gizmo_tolerance;
  const auto axis = nearest_axis(tolerance, [&](int i) { return distance_to_ring(gizmo.rings[i], cursor); });
  const float off = std::abs(glm::distance(cursor, gizmo.center) - gizmo_view_ring);
  if (axis) return axis;
  if (off <= tolerance) return Constraint{};
  if (!reach) return std::nullopt;
  return nearest_axis(gizmo_tolerance,
                      [&](int i) { return distance_to_ring(gizmo.rings[i], cursor, false); });
}

std::optional<Constraint> pick_arm(const Gizmo& gizmo, const glm::vec2& cursor, float tolerance) {
  return nearest_axis(tolerance, [&](int i) {
    const auto& arm = gizmo.arms[i];
    return arm.opacity >= faintest ? distance_to_segment(cursor, arm.base, arm.end) : 1e9f;
  });
}

std::optional<Constraint> pick_plane(const Gizmo& gizmo, const glm::vec2& cursor) {
  for (int i = 2; i >= 0; --i) {
    const int axis = gizmo.far_to_near[i];
    const auto& plane = gizmo.planes[axis];
    if (plane.opacity >= faintest && inside(plane.corners, cursor)) return Constraint{Kind::plane, axis};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Gizmo> make_gizmo(Tool tool, const glm::dvec3& center, const glm::dmat3& axes,
                                const document::Camera& camera) {
  const Layout layout{center, axes, camera};
  if (tool == Tool::select || tool == Tool::paint || !layout.projection.in_front()) return std::nullopt;
  Gizmo gizmo;
  gizmo.tool = tool;
  gizmo.center = glm::vec2(layout.projection.at());
  for (int axis = 0; axis < 3; ++axis) {
    if (tool == Tool::rotate) gizmo.rings[axis] = ring(layout, axis);
    gizmo.arms[axis] = arm(layout, axis);
    gizmo.planes[axis] = plane(layout, axis);
  }
  const auto nearness = [&](int axis) { return glm::dot(layout.unit(axis), layout.projection.to_eye()); };
  std::sort(gizmo.far_to_near.begin(), gizmo.far_to_near.end(),
            [&](int a, int b) { return nearness(a) < nearness(b); });
  return gizmo;
}

float distance_to_segment(const glm::vec2& p, const glm::vec2& a, const glm::vec2& b) {
  const glm::vec2 along = b - a;
  const float square = glm::dot(along, along);
  const float t = square > 0 ? std::clamp(glm::dot(p - a, along) / square, 0.0f, 1.0f) : 0.0f;
  return glm::distance(p, a + t * along);
}

std::optional<Constraint> pick_handle(const Gizmo& gizmo, const glm::vec2& cursor, bool reach) {
  if (gizmo.tool == Tool::rotate) return pick_ring(gizmo, cursor, reach);
  if (glm::distance(cursor, gizmo.center) <= gizmo_center + 1) return Constraint{};
  if (const auto arm = pick_arm(gizmo, cursor, reach ? gizmo_reach : gizmo_tolerance)) return arm;
  return pick_plane(gizmo, cursor);
}

std::string handle_name(Tool tool, const Constraint& handle) {
  const std::string letters = "XYZ";
  const std::string axis(1, letters[handle.axis]);
  const std::string plane = letters.substr(0, handle.axis) + letters.substr(handle.axis + 1);
  const bool free = handle.kind == Kind::free;
  switch (tool) {
    case Tool::rotate: return free ? "Rotate in the view plane" : "Rotate about " + axis;
    case Tool::scale:
      return free ? "Scale uniformly" : "Scale along " + (handle.kind == Kind::axis ? axis : plane);
    default:
      return free                        ? "Move in the view plane"
             : handle.kind == Kind::axis ? "Move along " + axis
                                         : "Move in " + plane;
  }
}

namespace {

constexpr float reach = 32, margin = 12, named_ball = 9, plain_ball = 7;  // in logical pixels
constexpr float smallest_view = 160;

}  // namespace

document::StandardView AxisBall::view(document::UpAxis up) const {
  using V = document::StandardView;
  constexpr V views[3][3][2] = {{{V::left, V::right}, {V::bottom, V::top}, {V::back, V::front}},
                                {{V::left, V::right}, {V::front, V::back}, {V::bottom, V::top}},
                                {{V::left, V::right}, {V::top, V::bottom}, {V::front, V::back}}};
  return views[static_cast<std::size_t>(up)][axis][positive ? 1 : 0];
}

const AxisBall* AxisWidget::ball(const glm::vec2& cursor) const {
  const auto found = std::find_if(balls.rbegin(), balls.rend(), [&](const AxisBall& ball) {
    return glm::distance(cursor, ball.at) <= ball.radius + 2;
  });
  return found == balls.rend() ? nullptr : &*found;
}

std::optional<AxisWidget> axis_widget(const document::Camera& camera) {
  const document::Viewport& v = camera.viewport;
  if (std::min(v.size.x, v.size.y) < smallest_view) return std::nullopt;
  AxisWidget widget;
  widget.center = {v.origin.x + v.size.x - axes_radius - margin, v.origin.y + axes_radius + margin};
  for (int i = 0; i < 6; ++i) {
    const bool positive = i < 3;
    glm::vec3 d(0);
    d[i % 3] = positive ? 1.0f : -1.0f;
    const glm::vec2 side(glm::dot(d, camera.right()), -glm::dot(d, camera.up()));
    widget.balls[i] = {i % 3, positive, widget.center + reach * side, -glm::dot(d, camera.forward()),
                       positive ? named_ball : plain_ball};
  }
  std::stable_sort(widget.balls.begin(), widget.balls.end(),
                   [](const AxisBall& a, const AxisBall& b) { return a.nearness < b.nearness; });
  return widget;
}

void look_from(document::Camera& camera, const AxisBall& ball) {
  AxisBall side = ball;
  if (ball.nearness > 0.9999f) side.positive = !side.positive;
  camera.look(side.view(camera.pose().up));
}

}  // namespace viete::interact
