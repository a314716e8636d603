// Projects points to pixels, and the cursor to axes, rotations and planes.
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
  Projector(const document::Space& space, const document::Camera& camera, const document::Viewport& viewport);

  /// Returns x and y in logical pixels, and the depth. Returns nullopt for a point behind the camera.
  std::optional<glm::vec3> operator()(const mesh::Point& p) const;
  /// Clips the segment to the near plane and projects both ends; nullopt if no part of it is in front.
  std::optional<std::array<glm::vec3, 2>> segment(const mesh::Point& a, const mesh::Point& b) const;

private:
  glm::vec4 clip(const mesh::Point& p) const;
  glm::vec3 on_screen(const glm::vec4& clip) const;

  document::Space space_;
  glm::mat4 view_, projection_, to_depth_;
  glm::vec2 window_;
};

/// Projects a point to the window, and the cursor to axes and planes through the point. Points and lengths
/// are in view units, cursors in logical pixels.
class CursorProjection {
public:
  CursorProjection(const glm::dvec3& point, const document::Camera& camera,
                   const document::Viewport& viewport);

  bool in_front() const { return in_front_; }
  glm::dvec2 at() const { return at_; }
  /// View units per logical pixel at the point.
  double per_pixel() const { return per_pixel_; }
  /// The direction from the point to the eye, of length 1.
  glm::dvec3 to_eye() const { return to_eye_; }

  /// Returns the motion on screen, in pixels, per view unit of motion in this direction.
  glm::dvec2 motion(const glm::dvec3& direction) const;

  /// Returns the distance from the point to the position under the cursor on the axis. If the axis points at
  /// the eye, returns 0. Near the vanishing point, returns at most 20 times the orthographic distance.
  double along(const glm::dvec3& axis, const glm::dvec2& cursor) const;

  /// Returns the angle of the cursor about the axis, in radians in (-pi, pi], relative to a fixed direction.
  /// Returns nullopt if a ring around the axis is seen edge-on.
  std::optional<double> angle(const glm::dvec3& axis, const glm::dvec2& cursor) const;

  /// Returns the rotation, in radians, that moves the near side of a ring by `pixels`. The ring is seen
  /// edge-on and has a radius in pixels.
  double edge_on_angle(const glm::dvec3& axis, const glm::dvec2& pixels, double radius) const;

  /// Returns the intersection of the ray with the plane through the point. Returns nullopt if the plane is
  /// seen edge-on, or the cursor is above the plane's horizon.
  std::optional<glm::dvec3> in_plane(const glm::dvec3& normal, const document::Ray& ray) const;

private:
  glm::dvec3 point_, right_, up_, forward_, to_eye_;
  glm::dvec2 at_, slope_;  // the slope of the ray through the point is 0 in an orthographic view
  double depth_, per_pixel_;
  bool orthographic_, in_front_;
};

/// Two orthonormal axes with cross(u, v) == axis, for a given axis of length 1.
struct PlaneAxes {
  glm::dvec3 u, v;
};
PlaneAxes plane_axes(const glm::dvec3& axis);

}  // namespace viete::interact
