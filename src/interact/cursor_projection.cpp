#include "interact/cursor_projection.h"

#include <algorithm>
#include <cmath>

namespace viete::interact {

Projector::Projector(const document::Space& space, const document::Camera& camera)
    : space_(space), view_(camera.view()), projection_(camera.projection()), window_(camera.viewport.window) {
  to_depth_ = glm::inverse(projection_);
}

glm::vec4 Projector::clip(const mesh::Point& p) const {
  return projection_ * (view_ * glm::vec4(space_.to_view(p), 1));
}

glm::vec3 Projector::on_screen(const glm::vec4& clip) const {
  const glm::vec2 ndc = glm::vec2(clip) / clip.w;
  return {(0.5f + 0.5f * ndc.x) * window_.x, (0.5f - 0.5f * ndc.y) * window_.y, -(to_depth_ * clip).z};
}

std::optional<glm::vec3> Projector::operator()(const mesh::Point& p) const {
  const glm::vec4 at = clip(p);
  if (!(at.w > 0)) return std::nullopt;
  return on_screen(at);
}

std::optional<std::array<glm::vec3, 2>> Projector::segment(const mesh::Point& a, const mesh::Point& b) const {
  glm::vec4 from = clip(a), to = clip(b);
  const float front_a = from.z + from.w, front_b = to.z + to.w;
  if (!(front_a > 0 || front_b > 0)) return std::nullopt;
  if (front_a < 0) from = glm::mix(from, to, front_a / (front_a - front_b));
  if (front_b < 0) to = glm::mix(to, from, front_b / (front_b - front_a));
  if (!(from.w > 0 && to.w > 0)) return std::nullopt;
  return std::array{on_screen(from), on_screen(to)};
}

namespace {

constexpr double edge_on = 0.12;  // a plane is edge-on if the sine of its angle to the view direction is less

}  // namespace

CursorProjection::CursorProjection(const glm::dvec3& point, const document::Camera& camera)
    : point_(point),
      right_(camera.right()),
      up_(camera.up()),
      forward_(camera.forward()),
      orthographic_(camera.pose().orthographic) {
  const glm::dvec3 from_eye = point - glm::dvec3(camera.eye());
  const glm::dvec2 side(glm::dot(from_eye, right_), glm::dot(from_eye, up_));
  depth_ = glm::dot(from_eye, forward_);
  in_front_ = orthographic_ || depth_ > 0.01 * camera.pose().distance;
  per_pixel_ = camera.per_pixel(depth_);
  slope_ = orthographic_ ? glm::dvec2(0) : side / depth_;
  to_eye_ = orthographic_ ? -forward_ : -glm::normalize(from_eye);
  at_ = glm::dvec2(camera.viewport.middle()) + glm::dvec2(side.x, -side.y) / per_pixel_;
}

// The point is at depth z. A motion by t * d moves it by t * side (right, up) and t * n (forward). It then
// appears at (slope * z + t * side) / (z + t * n). The derivative at t = 0 is (side - slope * n) / z.
glm::dvec2 CursorProjection::motion(const glm::dvec3& d) const {
  const glm::dvec2 side(glm::dot(d, right_), glm::dot(d, up_));
  const glm::dvec2 moved = side - glm::dot(d, forward_) * slope_;
  return glm::dvec2(moved.x, -moved.y) / per_pixel_;
}

// A point at distance t along the axis appears at u = t * speed / (1 + t * bend) on screen. Solves for t.
double CursorProjection::along(const glm::dvec3& axis, const glm::dvec2& cursor) const {
  const glm::dvec2 m = motion(axis);
  const double speed = glm::length(m);
  if (speed * per_pixel_ < 0.05) return 0;
  const double u = glm::dot(cursor - at_, m) / speed;
  const double bend = orthographic_ ? 0 : glm::dot(axis, forward_) / depth_;
  return u / std::max(speed - u * bend, 0.05 * speed);
}

std::optional<double> CursorProjection::angle(const glm::dvec3& axis, const glm::dvec2& cursor) const {
  const PlaneAxes across = plane_axes(axis);
  const glm::dvec2 u = motion(across.u), v = motion(across.v), d = cursor - at_;
  const double area = u.x * v.y - u.y * v.x;
  if (std::abs(area) * per_pixel_ * per_pixel_ < edge_on) return std::nullopt;
  return std::atan2((u.x * d.y - u.y * d.x) / area, (d.x * v.y - d.y * v.x) / area);
}

double CursorProjection::edge_on_angle(const glm::dvec3& axis, const glm::dvec2& pixels,
                                       double radius) const {
  const glm::dvec2 m = motion(glm::cross(axis, to_eye_));
  const double speed = glm::length(m);
  return speed > 0 ? glm::dot(pixels, m) / (speed * radius) : 0;
}

std::optional<glm::dvec3> CursorProjection::in_plane(const glm::dvec3& normal,
                                                     const document::Ray& ray) const {
  const double slope = glm::dot(ray.direction, normal), slope_at_point = -glm::dot(to_eye_, normal);
  if (std::abs(slope) < 0.5 * edge_on || slope * slope_at_point <= 0) return std::nullopt;
  return ray.origin + glm::dot(point_ - ray.origin, normal) / slope * ray.direction;
}

PlaneAxes plane_axes(const glm::dvec3& axis) {
  int smallest = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(axis[i]) < std::abs(axis[smallest])) smallest = i;
  }
  glm::dvec3 other(0);
  other[smallest] = 1;
  const glm::dvec3 u = glm::normalize(glm::cross(other, axis));
  return {u, glm::cross(axis, u)};
}

}  // namespace viete::interact
