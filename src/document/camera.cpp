#include "document/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "document/range.h"

namespace viete::document {

namespace {

constexpr float ease_seconds = 0.15f;
constexpr float half_pi = 1.57079633f;

glm::mat4 perspective_lens(float distance, float aspect) {
  const float near_plane = std::max(0.01f * distance, 1e-4f);
  const float far_plane = distance + 20.0f + 20.0f * near_plane;
  return glm::perspective(Camera::vertical_field, aspect, near_plane, far_plane);
}

// Returns a projection that begins behind the eye, so that zooming in does not clip the model.
glm::mat4 orthographic_lens(float distance, float aspect) {
  const float half = distance * std::tan(0.5f * Camera::vertical_field);
  return glm::ortho(-half * aspect, half * aspect, -half, half, -20.0f, distance + 20.0f);
}

float clamped(float value, float least, float most, float otherwise) {
  return std::isfinite(value) ? std::clamp(value, least, most) : otherwise;
}

CameraPose in_range(CameraPose pose) {
  const CameraPose home;
  constexpr auto far = static_cast<float>(farthest_place);
  for (int i = 0; i < 3; ++i) pose.target[i] = clamped(pose.target[i], -far, far, home.target[i]);
  pose.distance = clamped(pose.distance, nearest_camera, farthest_camera, home.distance);
  pose.yaw = std::isfinite(pose.yaw) ? pose.yaw : home.yaw;
  pose.pitch = clamped(pose.pitch, -half_pi, half_pi, home.pitch);
  return pose;
}

CameraPose mix(const CameraPose& a, const CameraPose& b, float t) {
  return {glm::mix(a.target, b.target, t),
          a.distance * std::pow(b.distance / a.distance, t),
          glm::mix(a.yaw, b.yaw, t),
          glm::mix(a.pitch, b.pitch, t),
          b.orthographic,
          b.up};
}

// Converts a direction from coordinates with Y up to coordinates with the file's up axis `up`.
glm::vec3 in_file(const glm::vec3& v, UpAxis up) {
  switch (up) {
    case UpAxis::z: return {v.x, -v.z, v.y};
    case UpAxis::minus_y: return {v.x, -v.y, -v.z};
    default: return v;
  }
}

}  // namespace

// Source: T. Moeller and B. Trumbore, Fast, Minimum Storage Ray/Triangle Intersection (1997).
std::optional<RayHit> hit_triangle(const Ray& ray, const std::array<glm::dvec3, 3>& t) {
  const glm::dvec3 u = t[1] - t[0], v = t[2] - t[0], from = ray.origin - t[0];
  const glm::dvec3 p = glm::cross(ray.direction, v), q = glm::cross(from, u);
  const double volume = glm::dot(u, p), a = glm::dot(from, p) / volume,
               b = glm::dot(ray.direction, q) / volume;
  if (!(a >= 0 && b >= 0 && a + b <= 1)) return std::nullopt;
  return RayHit{glm::dot(v, q) / volume, {1 - a - b, a, b}};
}

void Camera::set_pose(const CameraPose& pose) {
  current_ = pose;
  jump();
}

// Ends a running animation at the current pose.
void Camera::jump() {
  goal_ = current_ = in_range(current_);
  remaining_ = 0;
}

glm::vec3 Camera::forward() const {
  const float c = std::cos(current_.pitch);
  return in_file({-c * std::sin(current_.yaw), -std::sin(current_.pitch), -c * std::cos(current_.yaw)},
                 current_.up);
}

glm::vec3 Camera::right() const {
  return in_file({std::cos(current_.yaw), 0, -std::sin(current_.yaw)}, current_.up);
}
glm::vec3 Camera::up() const {
  return glm::cross(right(), forward());
}
glm::vec3 Camera::eye() const {
  return current_.target - current_.distance * forward();
}

glm::mat4 Camera::view() const {
  return glm::lookAt(eye(), current_.target, up());
}

float Camera::depth(const glm::vec3& point) const {
  return glm::dot(point - eye(), forward());
}

glm::mat4 Camera::projection() const {
  const float aspect = viewport.window.x / std::max(viewport.window.y, 1.0f);
  const glm::mat4 lens = current_.orthographic ? orthographic_lens(current_.distance, aspect)
                                               : perspective_lens(current_.distance, aspect);
  const glm::vec2 middle = viewport.middle() / viewport.window * 2.0f - 1.0f;
  return glm::translate(glm::mat4(1), {middle.x, -middle.y, 0}) * lens;
}

double Camera::per_pixel(double depth) const {
  const double at = current_.orthographic ? current_.distance : depth;
  return 2.0 * at * std::tan(0.5 * double(vertical_field)) / viewport.window.y;
}

Ray Camera::ray(const glm::vec2& cursor) const {
  const glm::vec2 from_middle = cursor - viewport.middle();
  if (current_.orthographic)
    return {glm::dvec3(eye()) + plane_displacement(from_middle, 1), glm::dvec3(forward())};
  return {glm::dvec3(eye()), glm::normalize(glm::dvec3(forward()) + plane_displacement(from_middle, 1))};
}

void Camera::set_orthographic(bool orthographic) {
  current_.orthographic = goal_.orthographic = orthographic;
}

void Camera::set_up(UpAxis up) {
  current_.up = goal_.up = start_.up = up;
}

glm::dvec3 Camera::plane_displacement(const glm::vec2& pixels, double depth) const {
  const double k = per_pixel(depth);
  return k * (double(pixels.x) * glm::dvec3(right()) - double(pixels.y) * glm::dvec3(up()));
}

void Camera::orbit(const glm::vec2& pixels) {
  constexpr float radians_per_pixel = 0.0075f;
  current_.yaw = std::remainder(current_.yaw - radians_per_pixel * pixels.x, 4 * half_pi);
  current_.pitch = std::clamp(current_.pitch + radians_per_pixel * pixels.y, -half_pi, half_pi);
  jump();
}

void Camera::pan(const glm::vec2& pixels) {
  current_.target -= glm::vec3(plane_displacement(pixels, current_.distance));
  jump();
}

void Camera::zoom(float steps, const glm::vec2& cursor) {
  const float distance =
      std::clamp(current_.distance * std::pow(0.88f, steps), nearest_camera, farthest_camera);
  const glm::vec2 from_middle = cursor - viewport.middle();
  const glm::dvec3 before = plane_displacement(from_middle, current_.distance);
  current_.distance = distance;
  current_.target += glm::vec3(before - plane_displacement(from_middle, distance));
  jump();
}

void Camera::ease_to(const CameraPose& goal) {
  start_ = current_;
  start_.yaw = std::remainder(start_.yaw, 4 * half_pi);
  goal_ = in_range(goal);
  goal_.yaw = start_.yaw + std::remainder(goal_.yaw - start_.yaw, 4 * half_pi);
  remaining_ = ease_seconds;
}

void Camera::center(const glm::vec3& target) {
  CameraPose goal = destination();
  goal.target = target;
  ease_to(goal);
}

void Camera::look(StandardView view) {
  // Yaw and pitch in the order of StandardView.
  constexpr float sides[][2] = {{0, 0},        {2 * half_pi, 0}, {half_pi, 0},
                                {-half_pi, 0}, {0, half_pi},     {0, -half_pi}};
  const CameraPose home;
  CameraPose goal = destination();
  const bool goes_home = view == StandardView::home;
  goal.yaw = goes_home ? home.yaw : sides[static_cast<std::size_t>(view)][0];
  goal.pitch = goes_home ? home.pitch : sides[static_cast<std::size_t>(view)][1];
  ease_to(goal);
}

// Centers the points in the area above the lowest `covered` pixels.
void Camera::frame(std::span<const glm::vec3> points, bool eased, float covered) {
  if (points.empty()) return;
  constexpr float margin = 1.14f, smallest = 0.15f;
  Camera goal = *this;
  if (moving()) goal.set_pose(goal_);
  const glm::vec3 middle = center_of(points);
  const float half_field = std::tan(0.5f * vertical_field);
  const glm::vec2 tangent =
      half_field * (viewport.seen() - glm::vec2(0, covered)) / viewport.window.y / margin;
  // The slope of the view ray to the free area's center, which is above the pane's center.
  const float raised = half_field * covered / viewport.window.y;
  float distance = smallest / std::min(tangent.x, tangent.y);
  for (const auto& p : points) {
    const glm::vec3 d = p - middle;
    const float nearer = current_.orthographic ? 0 : -glm::dot(d, goal.forward());
    const glm::vec2 side(std::abs(glm::dot(d, goal.right())),
                         std::abs(glm::dot(d, goal.up()) + raised * nearer));
    distance = std::max(distance, std::max(side.x / tangent.x, side.y / tangent.y) + nearer);
  }
  goal.current_.distance = std::clamp(distance, nearest_camera, farthest_camera);
  goal.current_.target = middle - raised * goal.current_.distance * goal.up();
  if (eased) return ease_to(goal.current_);
  set_pose(goal.current_);
}

bool Camera::animate(float seconds) {
  if (!moving()) return false;
  remaining_ -= seconds;
  if (remaining_ <= 0) {
    current_ = goal_;
    current_.yaw = std::remainder(current_.yaw, 4 * half_pi);
    jump();
    return true;
  }
  const float t = 1 - remaining_ / ease_seconds;
  current_ = mix(start_, goal_, t * t * (3 - 2 * t));
  return true;
}

glm::vec3 center_of(std::span<const glm::vec3> points) {
  glm::vec3 low = points[0], high = points[0];
  for (const auto& p : points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return 0.5f * (low + high);
}

}  // namespace viete::document
