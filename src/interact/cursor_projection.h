// Projection between the scene and the window: points to pixels, and the cursor to a length along an axis, an
// angle about an axis, or a point in a plane.
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

  /// x, y in logical pixels, z the depth in front of the camera; nullopt for points behind it.
  std::optional<glm::vec3> operator()(const mesh::Point& p) const;
  /// The segment clipped to the near plane, both ends projected; nullopt if none is in front.
  std::optional<std::array<glm::vec3, 2>> segment(const mesh::Point& a, const mesh::Point& b) const;

private:
  glm::vec4 clip(const mesh::Point& p) const;
  glm::vec3 on_screen(const glm::vec4& clip) const;

  document::Space space_;
  glm::mat4 view_, projection_, to_depth_;
  glm::vec2 window_;
};

/// A projected point, and cursors projected to axes and planes through it. Points, axes and lengths in view
/// units, cursors in logical pixels.
class CursorProjection {
public:
  CursorProjection(const glm::dvec3& point, const document::Camera& camera,
                   const document::Viewport& viewport);

  bool in_front() const { return in_front_; }
  glm::dvec2 at() const { return at_; }
  /// View units per logical pixel at the point.
  double per_pixel() const { return per_pixel_; }
  /// From the point to the eye, of length 1.
  glm::dvec3 to_eye() const { return to_eye_; }

  /// The point's screen velocity for a unit velocity in this direction, in pixels per view unit.
  glm::dvec2 motion(const glm::dvec3& direction) const;

  /// The position on the axis through the point that is under the cursor, as a distance from the point; exact
  /// in perspective too. 0 if the axis points at the eye; towards the vanishing point limited to 20 times the
  /// orthographic value.
  double along(const glm::dvec3& axis, const glm::dvec2& cursor) const;

  /// The angle of the cursor about the axis through the point, radians in (-pi, pi], from an arbitrary zero.
  /// Nullopt if the ring around the axis is seen edge-on.
  std::optional<double> angle(const glm::dvec3& axis, const glm::dvec2& cursor) const;

  /// For a ring of this radius (pixels) seen edge-on: the rotation by which its near side follows the cursor.
  double edge_on_angle(const glm::dvec3& axis, const glm::dvec2& pixels, double radius) const;

  /// The intersection of the ray with the plane through the point; nullopt if the plane is seen edge-on, or
  /// the ray is beyond its horizon.
  std::optional<glm::dvec3> in_plane(const glm::dvec3& normal, const document::Ray& ray) const;

private:
  glm::dvec3 point_, right_, up_, forward_, to_eye_;
  glm::dvec2 at_, slope_;  // slope: of the ray through the point, 0 if orthographic
  double depth_, per_pixel_;
  bool orthographic_, in_front_;
};

/// Two orthonormal axes perpendicular to a unit axis: cross(u, v) == axis.
struct PlaneAxes {
  glm::dvec3 u, v;
};
PlaneAxes plane_axes(const glm::dvec3& axis);

}  // namespace viete::interact
