// Projects points to the screen, and the cursor to axes, rotations and planes.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "document/camera.h"
#include "document/space.h"

namespace viete::interact {

/// Maps points in file coordinates to logical pixels from the top left of the window.
class Projector {
public:
  Projector(const document::Space& space, const document::Camera& camera);

  /// Returns x and y in logical pixels, and the depth. If the point is behind the camera, returns nullopt.
  std::optional<glm::vec3> operator()(const mesh::Point& p) const;
  /// Clips the segment at the near plane, and projects both ends. If nothing is left, returns nullopt.
  std::optional<std::array<glm::vec3, 2>> segment(const mesh::Point& a, const mesh::Point& b) const;

private:
  glm::vec4 clip(const mesh::Point& p) const;
  glm::vec3 on_screen(const glm::vec4& clip) const;

  document::Space space_;
  glm::mat4 view_, projection_, to_depth_;
  glm::vec2 window_;
};

/// Projects a point to the window, and the cursor to axes and planes through the point. Points and lengths
/// are in view units, cursor positions in logical pixels.
class CursorProjection {
public:
  CursorProjection(const glm::dvec3& point, const document::Camera& camera);

  bool in_front() const { return in_front_; }
  glm::dvec2 at() const { return at_; }
  /// Returns the number of view units per logical pixel at the point.
  double per_pixel() const { return per_pixel_; }
  /// Returns the direction from the point to the eye, with length 1.
  glm::dvec3 to_eye() const { return to_eye_; }

  /// Returns the motion on screen, in pixels, for a motion of one view unit in this direction.
  glm::dvec2 motion(const glm::dvec3& direction) const;

  /// Returns the distance along the axis from the point to the cursor. If the axis points at the eye, returns
  /// 0. Limits the distance, because it would be infinite at the axis's vanishing point on screen.
  double along(const glm::dvec3& axis, const glm::dvec2& cursor) const;

  /// Returns the angle of the cursor about the axis, measured from a fixed direction, in (-pi, pi] radians.
  /// If the plane perpendicular to the axis is seen edge-on, returns nullopt.
  std::optional<double> angle(const glm::dvec3& axis, const glm::dvec2& cursor) const;

  /// Returns the rotation, in radians, that moves the near side of a ring by `pixels`. For rings that are
  /// seen edge-on. `radius` is in pixels.
  double edge_on_angle(const glm::dvec3& axis, const glm::dvec2& pixels, double radius) const;

  /// Returns the intersection of the ray with the plane through the point. If the plane is seen edge-on, or
  /// the cursor is above the plane's horizon, returns nullopt.
  std::optional<glm::dvec3> in_plane(const glm::dvec3& normal, const document::Ray& ray) const;

private:
  glm::dvec3 point_, right_, up_, forward_, to_eye_;
  glm::dvec2 at_, slope_;  // slope_: of the ray to the point, (right, up) / forward; 0 if orthographic
  double depth_, per_pixel_;
  bool orthographic_, in_front_;
};

/// Two orthonormal axes u and v with cross(u, v) == axis. The given axis has length 1.
struct PlaneAxes {
  glm::dvec3 u, v;
};
PlaneAxes plane_axes(const glm::dvec3& axis);

}  // namespace viete::interact
