#include "scene/hand/shape_handle.h"

#include <algorithm>
#include <cmath>

#include "scene/document/vectors.h"
#include "scene/hand/cursor_projection.h"
#include "scene/hand/gizmo.h"

namespace viete::scene {

namespace {

constexpr double radians_per_degree = 0.017453292519943295;
constexpr double taper_radius = 48;  // pixels, at a factor of 1
constexpr double most_bent = 360;  // degrees by the handle, which then is back where it began; numbers go on
constexpr float knob_tolerance = 10;

// Of a shaping that has ends: them, and circles about the one that goes.
class HandleView {
public:
  HandleView(const Shaping& shaping, const Space& space, const Camera& camera, const Viewport& viewport)
      : shaping_(shaping),
        space_(space),
        camera_(camera),
        viewport_(viewport),
        end_(seen(point_of(shaping.to))) {}

  bool in_front() const { return end_.in_front() && seen(point_of(shaping_.from)).in_front(); }
  const CursorProjection& end() const { return end_; }
  glm::dvec3 axis() const { return glm::normalize(shaping_.to - shaping_.from); }
  glm::dvec2 bent_end(double amount) const { return at(shaped(shaping_, amount, point_of(shaping_.to))); }

  std::vector<glm::vec2> way(double amount) const {
    constexpr int steps = 32;
    std::vector<glm::vec2> points;
    for (int i = 0; i <= steps; ++i) {
      const glm::dvec3 p = glm::mix(shaping_.from, shaping_.to, double(i) / steps);
      points.emplace_back(
          at(shaping_.shape == Shape::bend ? shaped(shaping_, amount, point_of(p)) : point_of(p)));
    }
    return points;
  }

  // About the way, from where the most of it is seen on.
  glm::vec2 on_ring(double degrees) const {
    const double angle = degrees * radians_per_degree,
                 radius = gizmo_radius * end_.per_pixel() / space_.scale;
    const glm::dvec3 a = axis(), side = glm::cross(shaping_.hinge, a);
    const glm::dvec3 arm = std::cos(angle) * side + std::sin(angle) * glm::cross(a, side);
    return glm::vec2(at(point_of(shaping_.to + radius * arm)));
  }
  std::vector<glm::vec2> ring(double degrees) const {
    const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(degrees) / 4)));
    std::vector<glm::vec2> points;
    for (int i = 0; i <= steps; ++i) points.push_back(on_ring(degrees * i / steps));
    return points;
  }

  std::vector<glm::vec2> circle(double factor) const {
    constexpr int steps = 96;
    std::vector<glm::vec2> points;
    for (int i = 0; i < steps; ++i) {
      const double angle = 360.0 * i / steps * radians_per_degree;
      points.emplace_back(end_.at() + taper_radius * factor * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return points;
  }

private:
  CursorProjection seen(const mesh::Point& p) const {
    return {glm::dvec3(space_.to_view(p)), camera_, viewport_};
  }
  glm::dvec2 at(const mesh::Point& p) const { return seen(p).at(); }

  const Shaping& shaping_;
  const Space& space_;
  const Camera& camera_;
  const Viewport& viewport_;
  CursorProjection end_;
};

bool has_ends(Shape shape) {
  return shape == Shape::bend || shape == Shape::twist || shape == Shape::taper;
}

// The amount near the last one at which the bent end is nearest to a place.
double bend_to(const HandleView& view, double last, const glm::dvec2& place) {
  const auto distance = [&](double amount) { return glm::distance(view.bent_end(amount), place); };
  double best = last;
  for (int i = 1; i <= 90; ++i) {
    for (const double amount : {last - i, last + i}) {
      if (distance(amount) < distance(best)) best = amount;
    }
  }
  double low = best - 1, high = best + 1;
  for (int i = 0; i < 30; ++i) {
    const double third = (high - low) / 3;
    if (distance(low + third) < distance(high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  return 0.5 * (low + high);
}

double twist_to(const HandleView& view, const HeldHandle& held, const glm::dvec2& cursor) {
  const glm::dvec3 axis = view.axis();
  const auto now = view.end().angle(axis, cursor), then = view.end().angle(axis, held.press);
  if (!now || !then)
    return held.taken +
           view.end().edge_on_angle(axis, cursor - held.press, gizmo_radius) / radians_per_degree;
  return held.amount +
         std::remainder((*now - *then) / radians_per_degree - (held.amount - held.taken), 360.0);
}

}  // namespace

bool ShapeHandle::contains(const glm::vec2& cursor) const {
  if (glm::distance(cursor, knob) <= knob_tolerance) return true;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (distance_to_segment(cursor, ring[i], ring[(i + 1) % ring.size()]) <= gizmo_tolerance) return true;
  }
  return false;
}

std::optional<ShapeHandle> shape_handle(const Shaping& shaping, double amount, const Space& space,
                                        const Camera& camera, const Viewport& viewport) {
  if (!has_ends(shaping.shape)) return std::nullopt;
  const HandleView view(shaping, space, camera, viewport);
  if (!view.in_front()) return std::nullopt;
  ShapeHandle handle;
  handle.way = view.way(amount);
  if (shaping.shape == Shape::bend) {
    handle.start = view.way(0);
    handle.knob = handle.way.back();
  } else if (shaping.shape == Shape::twist) {
    handle.ring = view.ring(360);
    handle.swept = view.ring(std::fmod(amount, 360.0));
    handle.start = {handle.way.back(), view.on_ring(0)};
    handle.knob = view.on_ring(amount);
  } else {
    handle.ring = view.circle(std::abs(amount));
    handle.start = view.circle(1);
    handle.knob = handle.ring.front();
  }
  return handle;
}

double amount_by_handle(const Shaping& shaping, const HeldHandle& held, const glm::dvec2& cursor,
                        const Space& space, const Camera& camera, const Viewport& viewport) {
  const HandleView view(shaping, space, camera, viewport);
  if (shaping.shape == Shape::bend) {
    const double most = std::max(most_bent, std::abs(held.taken));
    return std::clamp(bend_to(view, held.amount, view.bent_end(held.taken) + cursor - held.press), -most,
                      most);
  }
  if (shaping.shape == Shape::twist) return twist_to(view, held, cursor);
  const glm::dvec2 center = view.end().at();
  const double grown = glm::distance(cursor, center) - glm::distance(held.press, center);
  return std::copysign(std::max(0.0, std::abs(held.taken) + grown / taper_radius), held.taken);
}

}  // namespace viete::scene
